// The parts of the extension module; each file adds its functions and classes. What people use is the Python package
// beside it, which is made of these.
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
void add_meshes(pybind11::module_&);
void add_scenes(pybind11::module_&);
void add_rendering(pybind11::module_&);
void add_viewing(pybind11::module_&);

/// What work tells of itself: the stage that it is in, and which share of that is done. By any thread.
using Progress = std::function<void(const char* stage, float share)>;

/// Calls work(cancelled, progress) in a thread of its own, while the calling thread asks for signals and tells `tell`,
/// a Python function of a stage and a number in [0, 1], or None. Rethrows what the work throws, or what a signal's
/// handler or `tell` has raised, once the work has ended. The calling thread holds the interpreter's lock, the work
/// does not.
void run_beside(const pybind11::object& tell,
                const std::function<void(const std::function<bool()>& cancelled, const Progress& progress)>& work);

}  // namespace phasetree::python
