#include "lights/emission_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace phasetree::tracer {

namespace {

constexpr double half_turn = std::numbers::pi;

// Bounds that lie at an edge to rounding count as within.
constexpr double slack = 1e-6;

// Of a group that the horizon cuts any lamp may be the one above it, so its cosine is not taken to be smaller.
constexpr double least_cosine = 1.0 / 16;

struct Angle {
    double cosine, sine;
};

// α − β, but not below 0, of angles from 0 to π.
Angle difference(const Angle& a, const Angle& b) {
    if (a.cosine >= b.cosine) return {1.0, 0.0};
    return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

double sine_of(double cosine) {
    return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

}  // namespace

EmissionCone::EmissionCone(const glm::dvec3& axis, double normals, double edge)
    : axis_(axis), cos_normals_(std::cos(normals)), sin_normals_(std::sin(normals)), cos_edge_(std::cos(edge)) {}

EmissionCone EmissionCone::of_plane(const glm::dvec3& normal) {
    return {normal, 0.0, half_turn / 2};
}

EmissionCone merged(const EmissionCone& a, const EmissionCone& b) {
    const bool a_is_wider = a.cos_normals_ <= b.cos_normals_;
    const EmissionCone &wide = a_is_wider ? a : b, &narrow = a_is_wider ? b : a;
    const double cos_edge = std::min(a.cos_edge_, b.cos_edge_);
    const auto angle_of = [](double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); };
    const double between = angle_of(glm::dot(wide.axis_, narrow.axis_));
    const double wide_angle = angle_of(wide.cos_normals_), narrow_angle = angle_of(narrow.cos_normals_);
    EmissionCone both = wide;
    both.cos_edge_ = cos_edge;
    if (between + narrow_angle <= wide_angle + slack) return both;
    // From the far edge of the one to the far edge of the other.
    const double angle = (wide_angle + between + narrow_angle) / 2;
    const glm::dvec3 aside = narrow.axis_ - glm::dot(wide.axis_, narrow.axis_) * wide.axis_;
    const double length = glm::length(aside), turn = angle - wide_angle;
    if (!(length > slack) && glm::dot(wide.axis_, narrow.axis_) > 0) {  // one axis, to rounding
        both.cos_normals_ = std::cos(std::min(between + narrow_angle, half_turn));
        both.sin_normals_ = sine_of(both.cos_normals_);
        return both;
    }
    // Axes that are opposite to each other leave open how to turn.
    if (angle >= half_turn || !(length > slack)) {
        both.cos_normals_ = -1.0;
        both.sin_normals_ = 0.0;
        return both;
    }
    both.axis_ = glm::normalize(std::cos(turn) * wide.axis_ + std::sin(turn) / length * aside);
    both.cos_normals_ = std::cos(angle);
    both.sin_normals_ = std::sin(angle);
    return both;
}

double EmissionCone::greatest_cosine(const glm::dvec3& towards, double cosine, double sine) const {
    const double to_axis = std::clamp(glm::dot(axis_, towards), -1.0, 1.0);
    const Angle to_normals = difference({to_axis, sine_of(to_axis)}, {cos_normals_, sin_normals_});
    const double least_angle_cosine = difference(to_normals, {cosine, sine}).cosine;
    return least_angle_cosine < cos_edge_ - slack ? 0.0 : std::max(least_angle_cosine, slack);
}

double EmissionCone::measure() const {
    // 2π ∫ sin θ over the normals, and the cosine-weighted rest up to θo + θe, as the source has it.
    const double normals = std::acos(std::clamp(cos_normals_, -1.0, 1.0));
    const double all = std::min(normals + std::acos(std::clamp(cos_edge_, -1.0, 1.0)), half_turn);
    return 2 * half_turn * (1 - cos_normals_) +
           half_turn / 2 *
               (2 * all * sin_normals_ - std::cos(normals - 2 * all) - 2 * normals * sin_normals_ + cos_normals_);
}

double EmissionBounds::received(const LightReceiver& at) const {
    if (!(intensity > 0.0)) return 0.0;
    const glm::dvec3 way = glm::dvec3(at.p) - glm::dvec3(sphere.centre);
    const double squared = glm::dot(way, way), radius = static_cast<double>(sphere.radius);
    const double squared_radius = radius * radius;
    // Within the sphere, light may come from anywhere. 3/(R² + d²) and 3/(3d² − R²) are close to the mean of one over
    // the squared distance of a place in the sphere, and the mean of the cosine in the middle is 1/4.
    if (!(squared > squared_radius * (1 + slack))) {
        const double cosine =
            at.normal && radius > 0.0 ? -glm::dot(way, glm::dvec3(*at.normal)) / (radius * (1 + slack)) : 1.0;
        return intensity * std::max((1 + cosine) * (1 + cosine) / 4, least_cosine) * 3 / (squared_radius + squared);
    }
    const double distance = std::sqrt(squared), sine = radius / distance;
    const double sent = cone.greatest_cosine(way / distance, std::sqrt(1 - sine * sine), sine);
    if (!(sent > 0.0)) return 0.0;
    double cosine = at.normal ? mean_cosine(sphere, at) : 1.0;
    if (cosine > 0.0 && at.normal && cosine < sine) cosine = std::max(cosine, least_cosine);
    return intensity * sent * cosine * 3 / (3 * squared - squared_radius);
}

// The cosines from c − s to c + s, with s = r/d, are taken to be equally frequent.
double mean_cosine(const BoundingSphere& sphere, const LightReceiver& at) {
    const glm::vec3 offset = sphere.centre - at.p;
    const auto distance = static_cast<double>(glm::length(offset)), radius = static_cast<double>(sphere.radius);
    if (!(distance > radius)) return 1.0;
    const double c = static_cast<double>(glm::dot(offset, *at.normal)) / distance, s = 1.0001 * radius / distance;
    if (c >= s) return c;
    return c > -s ? (c + s) * (c + s) / (4 * s) : 0.0;
}

}  // namespace phasetree::tracer
