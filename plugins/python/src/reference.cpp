// The lists of kinds, from which the package generates its functions, their documentation and the type stubs.
#include <pybind11/pybind11.h>

#include "module.hpp"
#include "phasetree/version.hpp"
#include "scene/reference.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

py::dict as_dict(const ParameterPage& p) {
    py::dict d;
    d["name"] = p.name;
    d["type"] = p.type;
    d["unit"] = p.unit;
    d["description"] = p.description;
    d["limits"] = p.limits;
    d["default"] = p.default_value;
    d["optional"] = p.optional;
    return d;
}

py::dict as_dict(const KindPage& page) {
    py::list parameters;
    for (const ParameterPage& p : page.parameters) parameters.append(as_dict(p));
    py::dict d;
    d["name"] = page.name;
    d["section"] = page.section;
    d["equation"] = page.equation;
    d["summary"] = page.summary;
    d["parameters"] = parameters;
    return d;
}

py::list chapters() {
    py::list all;
    for (const Chapter& chapter : tracer::scene_chapters()) {
        py::list kinds;
        for (const KindPage& page : chapter.pages) kinds.append(as_dict(page));
        py::dict d;
        d["title"] = chapter.title;
        d["text"] = chapter.text;
        d["kinds"] = kinds;
        all.append(d);
    }
    return all;
}

}  // namespace

void add_reference(py::module_& module) {
    module.attr("version") = version();
    module.attr("build_id") = build_id();
    module.def("chapters", &chapters, "The chapters of the reference: all kinds with their parameters.");
}

}  // namespace phasetree::python
