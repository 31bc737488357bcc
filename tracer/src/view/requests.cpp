#include "view/requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "phasetree/io/object_reader.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer::view {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name_of_request = "<request>";
constexpr std::size_t most_selected = 500;
constexpr Range exposures{-50, 50}, fractions{0, 1}, times{-1e9, 1e9}, indices{1, 4}, lengths{-1e6, 1e6};

Json list(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

Json maybe(const std::optional<float>& value) {
    return value ? Json(*value) : Json();
}

Json maybe(const std::optional<glm::vec3>& value) {
    return value ? list(*value) : Json();
}

Look read_look(const Document& document, Value value) {
    ObjectReader reader(document, value, "the look");
    Look look;
    look.is_clear = reader.optional<bool>("clear", false);
    if (const auto color = reader.value("color")) look.color = as_colour(document, *color, "\"color\"", fractions);
    look.ior = reader.maybe<float>("ior", indices);
    look.roughness = reader.maybe<float>("roughness", fractions);
    reader.finish();
    return look;
}

CutPlane read_cut(const Document& document, Value value) {
    ObjectReader reader(document, value, "the cut");
    CutPlane cut;
    cut.normal = reader.required<glm::vec3>("normal", lengths);
    cut.offset = reader.required<float>("offset", lengths);
    reader.finish();
    if (!(glm::length(cut.normal) > 1e-6f)) throw document.error(value, "the normal of the cut must not be zero");
    return cut;
}

Json written(const ShownPhase& phase) {
    const Optics seen = looking(phase.optics, phase.look);
    Json look = Json::object();
    if (phase.look.is_clear) look["clear"] = true;
    if (phase.look.color) look["color"] = list(*phase.look.color);
    if (phase.look.ior) look["ior"] = *phase.look.ior;
    if (phase.look.roughness) look["roughness"] = *phase.look.roughness;
    return {{"name", phase.name},
            {"hidden", phase.is_hidden},
            {"kind_in_file", phase.optics.kind},
            {"kind", seen.kind},
            {"has", {{"color", seen.has_color}, {"ior", seen.ior.has_value()}, {"roughness", seen.has_roughness}}},
            {"color", maybe(seen.color)},
            {"ior", maybe(seen.ior)},
            {"roughness", maybe(seen.roughness)},
            {"look", look}};
}

// Formats JSON as one line. Names from the scene are valid JSON text, but messages of the system may contain any bytes.
std::string line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Change read_change(const std::string& text, const Shown& shown) {
    const Document document = Document::from_text(text, name_of_request);
    ObjectReader reader(document, document.root(), "the change");
    Change change;
    if (const auto camera = reader.value("camera")) {
        change.has_camera = true;
        FilmSettings film;
        film.width = std::max(1, shown.resolution.x);
        film.height = std::max(1, shown.resolution.y);
        if (!camera->is_null()) change.camera = read_camera(document, *camera, film);
    }
    change.hidden = reader.maybe<std::vector<std::string>>("hidden");
    if (const auto looks = reader.value("looks")) {
        if (!looks->is_object()) throw document.error(*looks, "\"looks\" must be an object");
        change.looks.emplace();
        for (const Value look : *looks) change.looks->emplace(look.key(), read_look(document, look));
    }
    if (const auto cut = reader.value("cut")) {
        change.has_cut = true;
        if (!cut->is_null()) change.cut = read_cut(document, *cut);
    }
    if (const auto numbers = reader.value("numbers")) {
        if (!numbers->is_object()) throw document.error(*numbers, "\"numbers\" must be an object");
        change.numbers.emplace();
        for (const Value number : *numbers)
            change.numbers->emplace(number.key(), as<double>(document, number, "a number"));
    }
    change.hidden_parts = reader.maybe<std::vector<std::string>>("hidden_parts");
    if (change.hidden_parts && change.hidden_parts->size() > most_selected)
        throw document.error(reader.required_value("hidden_parts"),
                             fmt::format("at most {} parts may be hidden", most_selected));
    if (const auto seconds = reader.value("time")) change.seconds = as<double>(document, *seconds, "the time", times);
    change.layer = reader.maybe<std::string>("layer");
    if (change.layer && !change.layer->empty() &&
        std::ranges::none_of(shown.layers, [&](const FilmLayer& layer) { return layer.name == *change.layer; }))
        throw document.error(reader.required_value("layer"), fmt::format("unknown layer \"{}\"", *change.layer));
    change.exposure_ev = reader.maybe<float>("exposure", exposures);
    reader.finish();
    return change;
}

glm::vec2 read_place(const std::string& text, const Shown& shown) {
    const Document document = Document::from_text(text, name_of_request);
    ObjectReader reader(document, document.root(), "the place");
    const float x = reader.required<float>("x", {0, static_cast<double>(shown.resolution.x)});
    const float y = reader.required<float>("y", {0, static_cast<double>(shown.resolution.y)});
    reader.finish();
    return {x, y};
}

SelectedParts read_selected(const std::string& text) {
    const Document document = Document::from_text(text, name_of_request);
    ObjectReader reader(document, document.root(), "the selection");
    SelectedParts parts{reader.required<std::vector<std::string>>("pointers"),
                        reader.required<std::vector<std::string>>("phases")};
    if (parts.pointers.size() + parts.phases.size() > most_selected)
        throw document.error(document.root(), fmt::format("a selection may have at most {} parts", most_selected));
    reader.finish();
    return parts;
}

std::string written(const SelectionMask& mask) {
    Json json{{"picture", mask.picture}, {"width", mask.size.x}, {"height", mask.size.y}, {"runs", Json::array()}};
    std::size_t run = 0;
    bool is_selected = false;
    for (const bool pixel : mask.is_selected) {
        if (pixel != is_selected) {
            json["runs"].push_back(run);
            run = 0;
            is_selected = pixel;
        }
        ++run;
    }
    json["runs"].push_back(run);
    return line(json);
}

std::string written(const Shown& shown) {
    Json json;
    json["version"] = shown.version;
    json["scene"] = shown.scene;
    json["doing"] = shown.doing;
    json["error"] = shown.error;
    json["warning"] = shown.warning;
    json["width"] = shown.resolution.x;
    json["height"] = shown.resolution.y;
    json["wanted_samples"] = shown.samples;
    json["phases"] = Json::array();
    for (const ShownPhase& phase : shown.phases) json["phases"].push_back(written(phase));
    json["cut"] = Json();
    if (shown.cut) json["cut"] = {{"normal", list(shown.cut->normal)}, {"offset", shown.cut->offset}};
    json["layer"] = shown.layer;
    json["layers"] = Json::array();
    for (const FilmLayer& layer : shown.layers) json["layers"].push_back(layer.name);
    json["numbers"] = shown.numbers;
    json["hidden_parts"] = shown.hidden_parts;
    json["numbers_version"] = shown.numbers_version;
    json["time"] = shown.seconds;
    json["times"] = Json();
    if (shown.keys) json["times"] = {shown.keys->first, shown.keys->last};
    json["camera"] = shown.camera_text;
    json["centre"] = list(shown.centre);
    json["radius"] = shown.radius;
    json["exposure"] = shown.exposure_ev;
    json["seconds_to_picture"] = shown.seconds_to_picture;
    if (shown.picture) {
        Json& picture = json["picture"];
        picture["number"] = shown.picture->number;
        picture["width"] = shown.picture->linear.width;
        picture["height"] = shown.picture->linear.height;
        picture["scale"] = shown.picture->scale;
        picture["samples"] = shown.picture->samples;
    }
    return line(json);
}

std::string written(const Probed& probed) {
    Json json;
    json["origin"] = list(probed.origin);
    json["direction"] = list(probed.direction);
    json["start"] = probed.start;
    json["met"] = probed.met;
    json["point"] = list(probed.point);
    json["distances"] = Json::array();
    for (const ProbedDistance& d : probed.distances) json["distances"].push_back({{"phase", d.phase}, {"phi", d.phi}});
    json["crossings"] = Json::array();
    for (const ProbedCrossing& c : probed.crossings)
        json["crossings"].push_back({{"distance", c.distance}, {"from", c.from}, {"to", c.to}});
    json["has_more"] = probed.has_more;
    json["path"] = Json::array();
    for (const ProbedNode& n : probed.path)
        json["path"].push_back(
            {{"name", n.name}, {"file", n.file}, {"line", n.line}, {"column", n.column}, {"pointer", n.pointer}});
    return line(json);
}

std::string written(const TextNumbers& numbers, std::uint64_t version) {
    Json json;
    json["version"] = version;
    json["numbers"] = Json::array();
    for (const NumberInText& n : numbers.numbers)
        json["numbers"].push_back({{"pointer", n.pointer}, {"line", n.line}, {"value", n.value}});
    json["has_more"] = numbers.has_more;
    return line(json);
}

}  // namespace phasetree::tracer::view
