#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "phasetree/io/keys.hpp"
#include "phasetree/io/read_kind.hpp"
#include "scene/camera_kinds.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

struct NamedFilter {
    std::string_view name;
    PixelFilter filter;
};

const std::array<NamedFilter, 2>& filters() {
    static const std::array<NamedFilter, 2> all{
        {{"blackman_harris", PixelFilter()}, {"box", PixelFilter(PixelFilter::Shape::box, 0.5f)}}};
    return all;
}

// A camera without a named kind is a thin lens, which requires at least two members.
bool names_its_kind(Value value) {
    return value.is_object() && value.size() == 1 && value[0].is_object();
}

// The position of a camera that is rotated by its angle. Rodrigues' formula about the unit vector k is
//     k (k · d) + (d − k (k · d)) cos a + (k × d) sin a.
template <class Kind>
glm::vec3 turned_position(const Kind& kind) {
    if (kind.turn_degrees == 0.0f) return kind.position;
    // As in the camera itself, a zero axis is replaced by +y.
    const glm::dvec3 up = kind.up == glm::vec3(0.0f) ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(kind.up);
    const glm::dvec3 axis = glm::normalize(up), away = glm::dvec3(kind.position) - glm::dvec3(kind.look_at);
    const double angle = static_cast<double>(kind.turn_degrees) * std::numbers::pi / 180.0;
    const glm::dvec3 along = axis * glm::dot(axis, away);
    return glm::vec3(glm::dvec3(kind.look_at) + along + (away - along) * std::cos(angle) +
                     glm::cross(axis, away) * std::sin(angle));
}

template <class Kind>
AnyCameraParameters read_camera_of_kind(const Document& document, Value members, std::string_view what,
                                        FilmSettings& film) {
    return read_kind<Kind>(document, members, what, [&](const Kind& kind) {
        film.filter = filter_of_name(kind.filter_name);
        Kind turned = kind;
        turned.position = turned_position(kind);
        const AnyCameraParameters parameters = turned.made();
        (void)Camera(parameters, film.resolution());
        return parameters;
    });
}

// The distance along the axis to the plane of focus through the given point. `across` is the plane's normal, divided by
// its cosine with the axis.
template <class Kind>
float distance_of_focus(const Kind& kind, const glm::vec3& across) {
    if (kind.focus_distance)
        throw ParameterError("focus_at", "\"focus_at\" and \"focus_distance\" cannot be combined; remove one of them",
                             ParameterError::Place::key);
    const float distance = glm::dot(*kind.focus_at - kind.position, across);
    if (!(distance > 0)) throw ParameterError("focus_at", "\"focus_at\" is behind the camera");
    return distance;
}

}  // namespace

std::vector<std::string_view> names_of_filters() {
    std::vector<std::string_view> names;
    for (const NamedFilter& f : filters()) names.push_back(f.name);
    return names;
}

PixelFilter filter_of_name(std::string_view name) {
    for (const NamedFilter& f : filters())
        if (f.name == name) return f.filter;
    throw ParameterError("filter", fmt::format("unknown filter \"{}\"", name));
}

ThinLensParameters ThinLensKind::made() const {
    ThinLensParameters p = *this;
    if (focus_at) p.focus_distance = distance_of_focus(*this, glm::normalize(look_at - position));
    return p;
}

TiltShiftParameters TiltShiftKind::made() const {
    TiltShiftParameters p = *this;
    if (focus_at) {
        // The intersection of the axis with the tilted plane through the point.
        const glm::vec3 axis = glm::normalize(look_at - position);
        const glm::vec3 normal(TiltShift(*this, {1, 1}).focus_normal());
        p.focus_distance = distance_of_focus(*this, normal / glm::dot(normal, axis));
    }
    return p;
}

std::vector<CameraMoment> read_camera_moments(const Document& document, Value value, const Shutter& shutter) {
    std::vector<CameraMoment> moments;
    FilmSettings unused;
    for (const double moment : moments_of(document, value, shutter))
        moments.push_back({moment, read_camera(at_moment(document, shutter, moment), value, unused)});
    return moments;
}

AnyCameraParameters read_camera(const Document& document, Value value, FilmSettings& film) {
    if (value.is_object() && Keys::are_in(value))
        throw document.error(
            value.find("keys")->key_offset(),
            "a whole camera cannot have keys; give keys to its \"position\", its \"look_at\" or its numbers");
    if (!names_its_kind(value)) return read_camera_of_kind<ThinLensKind>(document, value, "the camera", film);
    AnyCameraParameters parameters;
    with_kind(CameraKinds(), document, value, "a camera", [&]<class Kind>(Value members) {
        parameters = read_camera_of_kind<Kind>(document, members, fmt::format("the {} camera", Kind::info.name), film);
    });
    return parameters;
}

}  // namespace phasetree::tracer
