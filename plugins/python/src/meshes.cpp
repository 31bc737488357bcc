// Meshes of an object's phases.
#include "arrays.hpp"
#include "embree_core/line_tracer.hpp"
#include "embree_core/prepared_object.hpp"
#include "module.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

py::tuple mesh(const embree::PreparedObject& object, float spacing, const py::object& tell) {
    PhaseMesh mesh;
    run_beside(tell, [&](const auto& cancelled, const auto& progress) {
        MeshOptions options;
        options.spacing = spacing;
        options.cancelled = cancelled;
        options.progress = [&](float share) { progress("meshing", share); };
        mesh = mesh_of(object.cells().bounds(), embree::line_tracer(object.scene()), options);
    });
    auto vertices = array_of<float>(mesh.vertices.size(), 3);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) put(vertices.mutable_data(), i, mesh.vertices[i]);
    const std::size_t n = mesh.triangles.size();
    auto triangles = array_of<std::uint32_t>(n, 3);
    auto behind = array_of<std::uint8_t>(n), front = array_of<std::uint8_t>(n);
    for (std::size_t i = 0; i < n; ++i) {
        const PhaseMesh::Triangle& t = mesh.triangles[i];
        std::copy(t.vertices.begin(), t.vertices.end(), triangles.mutable_data() + 3 * i);
        behind.mutable_data()[i] = t.behind.index;
        front.mutable_data()[i] = t.front.index;
    }
    return py::make_tuple(vertices, triangles, behind, front, mesh.spacing, mesh.crossings, mesh.skipped);
}

}  // namespace

void add_meshes(py::module_& module) {
    module.def("mesh", &mesh, py::arg("object"), py::arg("spacing"), py::arg("tell"));
}

}  // namespace phasetree::python
