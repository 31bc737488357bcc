// Trees as handles. A node of any kind is created from its text by the reader of scene files. Its children are handles,
// which the text refers to by name.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "module.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/model/renumber.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "scene/read_parts.hpp"
#include "while_watching_signals.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

// The text of a formula from a position to its end.
std::string part_of_formula(const std::string& text, std::size_t from) {
    const std::size_t end = std::min(text.find('"', from), from + 30);
    return text.substr(from, end - from);
}

// Generated text has no line numbers worth showing: keeps only the message, prefixed with the node.
ModelError without_place(const SceneError& e, const Document& document) {
    std::string text = e.message();
    const Value root = document.root();
    if (root.is_object() && root.size() == 1) {
        const std::string name(root[0].key());
        if (text.rfind(name + ":", 0) != 0) text = fmt::format("{}: {}", name, text);
    }
    // For a formula, quote the part in question; the text is one line of ASCII.
    if (e.line() == 1 && e.column() > 1 && root.is_object() && root.size() == 1 && root[0].key() == "formula")
        text += fmt::format(", at \"{}\"", part_of_formula(document.text(), e.column() - 1));
    if (e.suggestion()) text += fmt::format(" (did you mean \"{}\"?)", *e.suggestion());
    return ModelError(text);
}

PhaseNames names_of(const std::vector<std::string>& materials) {
    PhaseNames names;
    names.names.insert(names.names.end(), materials.begin(), materials.end());
    if (names.names.size() > Phase::capacity)
        throw ModelError(fmt::format("more than {} phases in one object", Phase::capacity - 1));
    return names;
}

KnownShapes known_shapes(const py::dict& parts) {
    KnownShapes known;
    for (const auto& [name, part] : parts) {
        if (py::isinstance<Field>(part))
            known.fields.emplace(name.cast<std::string>(), part.cast<Field>());
        else
            known.objects.emplace(name.cast<std::string>(), part.cast<Phased>());
    }
    return known;
}

template <class Handle>
Handle made(const std::string& text, const std::vector<std::string>& phases, const py::dict& parts) {
    KnownShapes known = known_shapes(parts);
    const Document document = Document::from_text(text);
    const FileReaders files = tracer::file_readers();
    try {
        return while_watching_signals([&] {
            if constexpr (std::is_same_v<Handle, Field>)
                return read_field(document, names_of(phases), std::move(known), files);
            else
                return read_object(document, names_of(phases), std::move(known), files);
        });
    } catch (const SceneError& e) {
        throw without_place(e, document);
    }
}

// Reads the field from a text that FieldHandle.text wrote.
Field field_of_text(const std::string& text) {
    const Document document = Document::from_text(text);
    std::optional<Value> value = document.root();
    for (const char* const key : {"tree", "set", "of"})
        if (value) value = value->find(key);
    if (!value) throw ModelError("the text does not describe a field");
    return while_watching_signals([&] { return read_field(document, *value, tracer::file_readers()); });
}

py::object as_tuple(const Bounds& b) {
    if (b.empty()) return py::none();
    return py::make_tuple(py::make_tuple(b.low.x, b.low.y, b.low.z), py::make_tuple(b.high.x, b.high.y, b.high.z));
}

std::vector<int> indices(PhaseSet set) {
    std::vector<int> all;
    for_each_phase(set.bits, [&](int i) { all.push_back(i); });
    return all;
}

template <class Handle>
Handle with_numbers(const Handle& handle, const std::vector<int>& numbers) {
    std::vector<Phase> phases;
    for (const int i : numbers) {
        if (i < 0 || i >= Phase::capacity) throw ModelError(fmt::format("{} is not a phase number", i));
        phases.push_back(Phase{static_cast<std::uint8_t>(i)});
    }
    return renumbered(handle, phases);
}

std::string text_of(const Phased& object, const std::vector<std::string>& phases,
                    const std::vector<std::string>& materials) {
    return write_tree({names_of(phases), object}, materials);
}

template <class Handle>
py::class_<Handle> add_handle(py::module_& module, const char* name) {
    py::class_<Handle> c(module, name);
    c.def_property_readonly("bounds", [](const Handle& h) { return as_tuple(bounds(h)); });
    c.def_property_readonly("nodes", [](const Handle& h) { return statistics(h).nodes; });
    c.def_property_readonly("depth", [](const Handle& h) { return statistics(h).depth; });
    c.def_property_readonly("bytes", [](const Handle& h) { return statistics(h).bytes; });
    c.def("is_same", [](const Handle& a, const Handle& b) { return a == b; });
    return c;
}

}  // namespace

void add_nodes(py::module_& module) {
    // text() returns the text of an object: the field, filled with the first of these phases.
    add_handle<Field>(module, "FieldHandle")
        .def("renumbered", &with_numbers<Field>)
        .def("text", [](const Field& field, const std::vector<std::string>& phases) {
            const std::vector<std::string> materials(phases.size(), "null");
            return text_of(Set{.phase = Phase{1}, .of = field}, phases, materials);
        });
    add_handle<Phased>(module, "ObjectHandle")
        .def_property_readonly("phases", [](const Phased& object) { return indices(phases(object)); })
        .def("renumbered", &with_numbers<Phased>)
        .def("text", &text_of);
    module.def("make_field", &made<Field>, py::arg("text"), py::arg("phases"), py::arg("parts"));
    module.def("field_of_text", &field_of_text, py::arg("text"));
    module.def("make_object", &made<Phased>, py::arg("text"), py::arg("phases"), py::arg("parts"));
}

}  // namespace phasetree::python
