#include "view/grab.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "phasetree/io/object_reader.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/preparation_watch.hpp"

namespace phasetree::tracer::view {

namespace {

using Json = nlohmann::ordered_json;

struct PictureRay {
    glm::dvec3 origin, direction;
};

PictureRay ray_at(const Camera& camera, const glm::dvec2& place) {
    // The middle of the unit square is the middle of the lens.
    const CameraRay ray = camera.generate(place, glm::vec2(0.5f));
    return {glm::dvec3(ray.origin), glm::normalize(glm::dvec3(ray.direction))};
}

// The distance between the rays of neighbouring pixels at a point.
double width_of_pixel(const Camera& camera, const glm::dvec2& place, const glm::dvec3& p) {
    const PictureRay ray = ray_at(camera, place + glm::dvec2(1, 0));
    return glm::length(glm::cross(ray.direction, p - ray.origin));
}

// Where the picture shows the object on a ray: as a distance.
double distance_in_picture(const Picture& picture, const PictureRay& picture_ray) {
    const TracedGeometry& geometry = picture.prepared->world().geometry();
    PathCounters counters;
    const glm::vec3 origin(picture_ray.origin), direction(picture_ray.direction);
    const Hit hit = geometry.intersect(Ray{origin, direction, geometry.label(origin), {}}, counters);
    const auto* surface = std::get_if<Surface>(&hit);
    if (!surface) throw ModelError("there is no surface at this point");
    if (surface->object != 0)
        throw ModelError("this is a mesh, which has no surface that parameters move; move it as a whole");
    return double{surface->distance};
}

// The change of phase nearest to a distance along a ray.
InterfacePoint surface_near(const PreciseEvaluator& object, const PictureRay& ray, double distance, double size) {
    const auto at = [&](double t) { return ray.origin + t * ray.direction; };
    for (double reach = 1e-5 * size; reach < 0.03 * size; reach *= 4) {
        double before = distance - reach, behind = distance + reach;
        const Phase outside = object.label(at(before)), entered = object.label(at(behind));
        if (outside == entered) continue;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (before + behind);
            (object.label(at(middle)) == outside ? before : behind) = middle;
        }
        return {object.label(at(behind)), outside, at(before)};
    }
    throw ModelError(
        "the object has no surface here: this is a cut, a hidden part, or a picture of the scene before the last "
        "change");
}

Json written(const Influence& one, double size) {
    return {{"pointer", one.parameter.pointer},
            {"value", one.parameter.value},
            {"unit", one.parameter.unit},
            {"strength", one.strength},
            {"motion", {one.motion.x, one.motion.y, one.motion.z}},
            {"per_size", one.parameter.scale / size}};
}

}  // namespace

Grabbed grab(const Picture& picture, const glm::vec2& place, const Document& document, const VariedObject::Parse& parse,
             const studio::Vocabulary& vocabulary) {
    const FlushSubnormals flush;
    Grabbed result{.object = std::make_shared<const VariedObject>(document, parse),
                   .camera = picture.camera,
                   .resolution = picture.viewed->scene.film.resolution(),
                   .point = {},
                   .influences = {}};
    const Camera camera(result.camera, result.resolution);
    const PictureRay ray = ray_at(camera, place);
    const double distance = distance_in_picture(picture, ray);
    const double size = result.object->size();
    result.point = surface_near(*result.object->with({}), ray, distance, size);
    result.facing = ray.direction;
    result.pixel = width_of_pixel(camera, place, result.point.position);
    const std::vector<DragParameter> parameters = drag_parameters(document, vocabulary, size);
    result.influences = influences(*result.object, result.point, parameters);
    if (result.influences.size() > Grabs::most_influences) result.influences.resize(Grabs::most_influences);
    if (result.influences.empty()) throw ModelError("no number in the scene moves this point");
    return result;
}

Dragged drag(const Grabbed& grabbed, const glm::vec2& place, const std::set<std::string>& chosen) {
    const FlushSubnormals flush;
    std::vector<DragParameter> parameters;
    for (const Influence& one : grabbed.influences)
        if (chosen.contains(one.parameter.pointer)) parameters.push_back(one.parameter);
    const Camera camera(grabbed.camera, grabbed.resolution);
    const PictureRay ray = ray_at(camera, place);
    Dragged result =
        drag(*grabbed.object, grabbed.point, parameters, {ray.origin, ray.direction, grabbed.facing, grabbed.pixel});
    for (const Influence& one : grabbed.influences) result.values.emplace(one.parameter.pointer, one.parameter.value);
    return result;
}

template <class Work>
auto Grabs::in_time(Work&& work) const {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + longest_;
    const PreparationWatch watch({.cancelled = [&] { return Clock::now() > end; }, .progress = {}});
    try {
        return work();
    } catch (const PreparationCancelled&) {
        throw ModelError(
            "this object takes too long to read again, so its surfaces cannot be dragged; change its numbers instead");
    }
}

std::string Grabs::grab(const std::string& request, const Shown& shown) {
    const Document text = Document::from_text(request, "<request>");
    ObjectReader reader(text, text.root(), "the place");
    const float x = reader.required<float>("x", {0, static_cast<double>(shown.resolution.x)});
    const float y = reader.required<float>("y", {0, static_cast<double>(shown.resolution.y)});
    reader.finish();
    if (!shown.picture) throw ModelError("there is no picture yet");
    const auto state = document_.state();
    if (!state->document) throw ModelError("the text is not valid; correct it first");
    Grabbed grabbed = in_time([&] {
        return view::grab(
            *shown.picture, {x, y}, state->document->at(shown.seconds),
            [this](std::string now) { return document_.parsed(std::move(now)); }, document_.vocabulary());
    });
    Json json;
    const std::lock_guard lock(mutex_);
    json["grab"] = grabbed.number = ++last_;
    const PhaseNames& names = grabbed.object->phases();
    json["inside"] = names[grabbed.point.inside];
    json["outside"] = names[grabbed.point.outside];
    json["point"] = {grabbed.point.position.x, grabbed.point.position.y, grabbed.point.position.z};
    json["pixel"] = grabbed.pixel;
    json["influences"] = Json::array();
    for (const Influence& one : grabbed.influences) json["influences"].push_back(written(one, grabbed.object->size()));
    grabs_.push_back(std::move(grabbed));
    if (grabs_.size() > most) grabs_.pop_front();
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Grabs::drag(const std::string& request, const Shown& shown) {
    const Document text = Document::from_text(request, "<request>");
    ObjectReader reader(text, text.root(), "the drag");
    const auto number = static_cast<std::uint64_t>(reader.required<double>("grab", {0, 9e15}));
    const float x = reader.required<float>("x", {0, static_cast<double>(shown.resolution.x)});
    const float y = reader.required<float>("y", {0, static_cast<double>(shown.resolution.y)});
    const auto chosen = reader.required<std::vector<std::string>>("chosen");
    reader.finish();
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(grabs_, number, &Grabbed::number);
    if (found == grabs_.end()) throw ModelError("this point is no longer grabbed; grab it again");
    const Dragged dragged = in_time([&] {
        return view::drag(*found, {x, y}, std::set<std::string>(chosen.begin(), chosen.end()));
    });
    Json json;
    json["values"] = dragged.values;
    json["miss"] = std::isfinite(dragged.miss) ? Json(dragged.miss) : Json();
    json["follows"] = dragged.follows;
    return json.dump();
}

}  // namespace phasetree::tracer::view
