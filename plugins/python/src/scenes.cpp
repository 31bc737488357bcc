// Reads and writes scene files: a file's content as Python values, and its object as a handle. Also checks parts
// written by users with the readers of scene files.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <span>

#include "module.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/parameter_type.hpp"
#include "phasetree/io/tree.hpp"
#include "scene/meshes_alone.hpp"
#include "scene/read_parts.hpp"
#include "scene/reference.hpp"
#include "scene/scene.hpp"
#include "while_watching_signals.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

// If `document` is given, which is that of a scene, the fields of materials become handles, because they may be names
// of shapes.
py::object as_python(Value value, const Document* document = nullptr) {
    switch (value.kind()) {
        case Kind::null:
            return py::none();
        case Kind::boolean:
            return py::bool_(value.boolean());
        case Kind::number: {
            const double number = value.number();
            const bool is_whole = value.written().find_first_of(".eE") == std::string_view::npos;
            if (is_whole && std::abs(number) < 9e15) return py::int_(static_cast<long long>(number));
            return py::float_(number);
        }
        case Kind::string:
            return py::str(std::string(value.string()));
        case Kind::array: {
            py::list list;
            for (const Value item : value) list.append(as_python(item, document));
            return list;
        }
        case Kind::object:
            break;
    }
    py::dict dict;
    // The members that are fields: those that control textures or numbers, and the density of a medium.
    std::string_view field;
    if (document != nullptr) field = value.find("ramp") ? "of" : value.find("density_depth") ? "density" : "";
    for (const Value member : value)
        dict[py::str(std::string(member.key()))] = member.key() == field
                                                       ? py::cast(read_field(*document, member, tracer::file_readers()))
                                                       : as_python(member, document);
    return dict;
}

// The object, which is None in a scene of meshes alone, and everything else in the scene except its tree. A scene with
// a camera must be complete.
py::tuple parts_of(const Document& document) {
    SceneTree tree;
    const Value root = document.root();
    if (root.find("camera")) {
        tracer::Scene scene = while_watching_signals([&] { return tracer::read_scene(document); });
        tree = {scene.phases, scene.object};
    } else {
        tracer::SceneModel model = while_watching_signals([&] { return tracer::read_scene_without_camera(document); });
        tree = {std::move(model.phases), std::move(model.object)};
    }
    py::dict rest;
    for (const Value part : root)
        if (part.key() != "tree" && part.key() != "shapes" && part.key() != "version")
            rest[py::str(std::string(part.key()))] = as_python(part, &document);
    if (tracer::has_meshes_alone(document)) return py::make_tuple(py::none(), rest);
    return py::make_tuple(tree.object, rest);
}

// The matrices [M v] of affine maps, (N, 3, 4).
py::array_t<float> matrices(std::span<const tracer::Transform> maps) {
    py::array_t<float> result({static_cast<py::ssize_t>(maps.size()), py::ssize_t{3}, py::ssize_t{4}});
    float* out = result.mutable_data();
    for (const tracer::Transform& map : maps)
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) *out++ = static_cast<float>(map.matrix[column][row]);
            *out++ = static_cast<float>(map.by[row]);
        }
    return result;
}

// (name, matrices) for each run of instances of the same object or group.
py::list instances_of(const tracer::PlacedObjects& all, const std::vector<tracer::Instance>& instances) {
    py::list result;
    for (std::size_t i = 0; i < instances.size();) {
        const tracer::Instance& first = instances[i];
        std::vector<tracer::Transform> maps;
        for (; i < instances.size() && instances[i].of == first.of && instances[i].is_group == first.is_group; ++i)
            maps.push_back(instances[i].transform);
        result.append(
            py::make_tuple(first.is_group ? all.groups[first.of].name : all.objects[first.of].name, matrices(maps)));
    }
    return result;
}

// For a scene of several objects: the names and transforms of the objects, the instances in each group, and the
// instances of the scene itself. Reports all errors of the scene.
py::tuple placed_in(const Document& document) {
    const Value root = document.root();
    tracer::PlacedObjects all = while_watching_signals([&] {
        return root.find("camera") ? tracer::read_scene(document).placed
                                   : tracer::read_scene_without_camera(document).placed;
    });
    if (!all.moving.empty())
        throw document.error(*root.find("objects"),
                             "objects that move while the shutter is open are not supported here");
    py::list objects;
    for (const tracer::PlacedObject& object : all.objects)
        objects.append(py::make_tuple(object.name, matrices(std::span(&object.first, 1))));
    py::dict groups;
    for (const tracer::PlacedGroup& group : all.groups)
        groups[py::str(group.name)] = instances_of(all, group.instances);
    return py::make_tuple(objects, groups, instances_of(all, all.instances));
}

// Everything in a scene file that reads a file: its key, and the name of the parameter that holds the path. A key is
// the name of a kind, or that of a parameter whose value is such a kind, as "density_grid" is for voxels. The result is
// a set, because chapters share names: `image` is both a texture and a light.
std::set<std::pair<std::string, std::string>> keys_with_files() {
    std::set<std::pair<std::string, std::string>> all;
    const std::string type = ParameterType<std::filesystem::path>::describe({}).name;
    const std::vector<Chapter> chapters = tracer::scene_chapters();
    const auto for_each_parameter = [&](auto&& f) {
        for (const Chapter& chapter : chapters)
            for (const KindPage& page : chapter.pages)
                for (const ParameterPage& p : page.parameters) f(page, p);
    };
    for_each_parameter([&](const KindPage& page, const ParameterPage& p) {
        if (p.type == type) all.emplace(page.name, p.name);
    });
    const auto kinds = all;
    for_each_parameter([&](const KindPage&, const ParameterPage& p) {
        for (const auto& [kind, parameter] : kinds)
            if (p.type == kind) all.emplace(p.name, parameter);
    });
    return all;
}

// The end of a string in a text, after its closing quote.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    for (++at; text[at] != '"'; ++at)
        if (text[at] == '\\') ++at;
    return at + 1;
}

// Returns the text with each file that it names replaced by renamed(file).
std::string with_files(const std::string& text, const std::string& name, const py::function& renamed) {
    const Document document = Document::from_text(text, name);
    const auto keys = keys_with_files();
    std::vector<Value> files, open{document.root()};
    while (!open.empty()) {
        const Value value = open.back();
        open.pop_back();
        for (const auto& [key, parameter] : keys)
            if (value.is_object() && value.key() == std::string_view(key))
                if (const auto file = value.find(parameter); file && file->is_string()) files.push_back(*file);
        if (value.is_array() || value.is_object())
            for (const Value item : value) open.push_back(item);
    }
    std::ranges::sort(files, {}, &Value::offset);
    std::string result;
    std::size_t done = 0;
    const py::object quoted = py::module_::import("json").attr("dumps");
    for (const Value file : files) {
        result.append(text, done, file.offset() - done);
        result += quoted(renamed(std::string(file.string()))).cast<std::string>();
        done = end_of_string(text, file.offset());
    }
    return result.append(text, done);
}

// Parses JSON with comments, which Python's own parser rejects.
py::object value_of(const std::string& text) {
    return as_python(Document::from_text(text).root());
}

// Checks a part by itself, for example {"materials": …}. Throws Error with the reader's message, but without a
// position, because the text is generated.
void check_part(const std::string& part, const std::string& text) {
    const Document document = Document::from_text(text);
    tracer::FilmSettings film;
    try {
        const Value root = document.root();
        if (part == "material")
            (void)tracer::read_material(document, root);
        else if (part == "lights")
            (void)tracer::read_lights(document, root);
        else if (part == "meshes")
            (void)tracer::read_meshes(document, root);
        else if (part == "camera")
            (void)tracer::read_camera(document, root, film);
        else if (part == "render")
            (void)tracer::read_settings(document, root, film);
        else
            throw std::invalid_argument(part);
    } catch (const SceneError& e) {
        std::string message = e.message();
        if (e.suggestion()) message += fmt::format(" (did you mean \"{}\"?)", *e.suggestion());
        throw ModelError(message);
    }
}

}  // namespace

void add_scenes(py::module_& module) {
    module.def("read_file", [](const std::string& path) { return parts_of(Document::from_file(path)); });
    module.def("read_text", [](const std::string& text, const std::string& name) {
        return parts_of(Document::from_text(text, name));
    });
    module.def("placed_in_file", [](const std::string& path) { return placed_in(Document::from_file(path)); });
    module.def("text_of_file", [](const std::string& path) { return Document::from_file(path).text(); });
    module.def("with_files", &with_files, py::arg("text"), py::arg("name"), py::arg("renamed"));
    module.def("value_of", &value_of);
    module.def("check_part", &check_part, py::arg("part"), py::arg("text"));
}

}  // namespace phasetree::python
