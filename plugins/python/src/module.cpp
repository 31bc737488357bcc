#include "module.hpp"

#include "phasetree/version.hpp"

PYBIND11_MODULE(_phasetree, module) {
    using namespace phasetree::python;
    module.doc() = "Bindings of the C++ library, used by the package phasetree.";
    add_errors(module);
    add_reference(module);
    add_nodes(module);
    add_points(module);
    add_rays(module);
    add_precise(module);
    add_meshes(module);
    add_measures(module);
    add_proofs(module);
    add_scenes(module);
    add_rendering(module);
    add_viewing(module);
}
