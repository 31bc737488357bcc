// Translates C++ exceptions to Python exceptions with the same messages.
#include "phasetree/io/error.hpp"

#include <pybind11/pybind11.h>

#include "command/errors.hpp"
#include "embree_core/error.hpp"
#include "module.hpp"
#include "output/error.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "view/server.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

// The classes are attributes of the module and live as long as it does.
PyObject* class_of(const char* name) {
    const py::object found = py::module_::import("phasetree._phasetree").attr(name);
    return found.ptr();
}

void raise_scene_error(const SceneError& e) {
    const py::object error = py::reinterpret_borrow<py::object>(class_of("SceneError"))(e.what());
    error.attr("file") = e.file();
    error.attr("line") = e.line();
    error.attr("column") = e.column();
    error.attr("message") = e.message();
    error.attr("suggestion") = e.suggestion() ? py::object(py::str(*e.suggestion())) : py::object(py::none());
    PyErr_SetObject(class_of("SceneError"), error.ptr());
}

}  // namespace

void add_errors(py::module_& module) {
    py::exception<ModelError> base(module, "Error", PyExc_ValueError);
    base.attr("__doc__") = "An invalid tree, scene or call, with the message of the C++ library.";
    py::exception<SceneError> of_scenes(module, "SceneError", base.ptr());
    of_scenes.attr("__doc__") =
        "An invalid scene text: file, line and column (counted from 1; 0 if unknown), message and suggestion.";
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const SceneError& e) {
            raise_scene_error(e);
        } catch (const ModelError& e) {
            PyErr_SetString(class_of("Error"), e.what());
        } catch (const BuildCancelled& e) {
            PyErr_SetString(PyExc_KeyboardInterrupt, e.what());
        } catch (const embree::EmbreeError& e) {
            PyErr_SetString(PyExc_RuntimeError, e.what());
        } catch (const tracer::view::MissingLibraryError& e) {
            PyErr_SetString(PyExc_ImportError, e.what());
        } catch (const tracer::UsageError& e) {
            PyErr_SetString(class_of("Error"), e.what());
        } catch (const tracer::OutputError& e) {
            PyErr_SetString(PyExc_OSError, e.what());
        } catch (const tracer::DisplayError& e) {
            PyErr_SetString(class_of("Error"), e.what());
        }
    });
}

}  // namespace phasetree::python
