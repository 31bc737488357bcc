// The parts of the extension module, to which each file adds its functions and classes. Users see the Python package
// next to it, which is built on these.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

namespace phasetree::python {

void add_errors(pybind11::module_&);
void add_reference(pybind11::module_&);
void add_nodes(pybind11::module_&);
void add_points(pybind11::module_&);
void add_rays(pybind11::module_&);
void add_precise(pybind11::module_&);
void add_meshes(pybind11::module_&);
void add_measures(pybind11::module_&);
void add_proofs(pybind11::module_&);
void add_scenes(pybind11::module_&);
void add_rendering(pybind11::module_&);
void add_viewing(pybind11::module_&);

/// Receives the current stage of the work, and the completed fraction of that stage. Called by any thread.
using Progress = std::function<void(const char* stage, float share)>;

/// Calls work(cancelled, progress) in a separate thread, while the calling thread polls for signals and reports
/// progress to `tell`. `tell` is None or a Python function of a stage and a number in [0, 1]. Once the work has ended,
/// rethrows what the work threw, or what a signal handler or `tell` raised. The calling thread holds the interpreter's
/// lock; the work does not.
void run_beside(const pybind11::object& tell,
                const std::function<void(const std::function<bool()>& cancelled, const Progress& progress)>& work);

/// Like run_beside(), and returns made(): what is known when the work has ended. If Ctrl-C or `tell` ends it, the
/// exception gets that as its attribute `result`.
template <class Made>
auto run_for_result(const pybind11::object& tell,
                    const std::function<void(const std::function<bool()>& cancelled, const Progress& progress)>& work,
                    const Made& made) {
    try {
        run_beside(tell, work);
    } catch (pybind11::error_already_set& e) {
        if (e.value()) e.value().attr("result") = made();
        throw;
    }
    return made();
}

}  // namespace phasetree::python
