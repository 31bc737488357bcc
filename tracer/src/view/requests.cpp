#include "view/requests.hpp"

#include <nlohmann/json.hpp>

#include "phasetree/io/object_reader.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer::view {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name_of_request = "<request>";
constexpr Range exposures{-50, 50};

Json list(const glm::vec3& v) {
    return Json::array({v.x, v.y, v.z});
}

// Names of a scene may hold any bytes that JSON texts may; what a terminal or a system says may hold others.
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
    for (const ShownPhase& phase : shown.phases)
        json["phases"].push_back({{"name", phase.name}, {"hidden", phase.is_hidden}});
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
    return line(json);
}

}  // namespace phasetree::tracer::view
