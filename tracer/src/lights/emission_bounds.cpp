#include "lights/emission_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

// Axes that differ by less than this angle count as equal, and points outside of a sphere by less than this relative
// distance count as inside.
constexpr double axis_slack = 1e-6, distance_slack = 1e-6;

// Tolerance on the cosine of an angle at the edge of a cone. It keeps cosines of what lies at the edge above 0.
constexpr double cosine_slack = 1e-6;

// Where the horizon cuts a cluster, the light may come from a lamp well above it, so the cosine is at least this.
constexpr double least_cosine_at_horizon = 1.0 / 16;

struct Angle {
    double cosine, sine;
};

// α − β, clamped at 0, of angles from 0 to π.
Angle difference(const Angle& a, const Angle& b) {
    if (a.cosine >= b.cosine) return {1.0, 0.0};
    return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

double sine_of(double cosine) {
    return std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

double angle_of(double cosine) {
    return portable::acos(std::clamp(cosine, -1.0, 1.0));
}

}  // namespace

EmissionCone::EmissionCone(const glm::dvec3& axis, double normal_angle, double emission_angle)
    : axis_(axis),
      cos_normals_(std::cos(normal_angle)),
      sin_normals_(std::sin(normal_angle)),
      cos_emission_(std::cos(emission_angle)) {}

EmissionCone EmissionCone::of_plane(const glm::dvec3& normal) {
    return {normal, 0.0, std::numbers::pi / 2};
}

EmissionCone merged(const EmissionCone& a, const EmissionCone& b) {
    const bool a_is_wider = a.cos_normals_ <= b.cos_normals_;
    const EmissionCone &wide = a_is_wider ? a : b, &narrow = a_is_wider ? b : a;
    const double between = angle_of(glm::dot(wide.axis_, narrow.axis_));
    const double wide_angle = angle_of(wide.cos_normals_), narrow_angle = angle_of(narrow.cos_normals_);
    EmissionCone both = wide;
    both.cos_emission_ = std::min(a.cos_emission_, b.cos_emission_);
    if (between + narrow_angle <= wide_angle + axis_slack) return both;
    // From the far edge of one cone to the far edge of the other.
    const double angle = (wide_angle + between + narrow_angle) / 2;
    const glm::dvec3 aside = narrow.axis_ - glm::dot(wide.axis_, narrow.axis_) * wide.axis_;
    const double length = glm::length(aside), turn = angle - wide_angle;
    // Opposite axes do not define which way to turn, so all directions count.
    if (angle >= std::numbers::pi || !(length > axis_slack)) {
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
    if (!(cos_normals_ > -1.0)) return 1.0;  // all directions are normals
    const double to_axis = std::clamp(glm::dot(axis_, towards), -1.0, 1.0);
    const Angle to_normals = difference({to_axis, sine_of(to_axis)}, {cos_normals_, sin_normals_});
    const double least_angle_cosine = difference(to_normals, {cosine, sine}).cosine;
    return least_angle_cosine < cos_emission_ - cosine_slack ? 0.0 : std::max(least_angle_cosine, cosine_slack);
}

double EmissionCone::measure() const {
    // 2π ∫ sin θ over the normals, plus the rest up to θo + θe weighted by cosines, as in the reference.
    const double normals = angle_of(cos_normals_), all = std::min(normals + angle_of(cos_emission_), std::numbers::pi);
    return 2 * std::numbers::pi * (1 - cos_normals_) +
           std::numbers::pi / 2 *
               (2 * all * sin_normals_ - std::cos(normals - 2 * all) - 2 * normals * sin_normals_ + cos_normals_);
}

double EmissionBounds::received(const LightReceiver& at) const {
    if (!(intensity > 0.0)) return 0.0;
    const glm::dvec3 from_centre = glm::dvec3(at.p) - glm::dvec3(sphere.centre);
    const double squared = glm::dot(from_centre, from_centre), radius = static_cast<double>(sphere.radius);
    const double squared_radius = radius * radius;
    // A receiver inside the sphere may receive light from all around. 3/(R² + d²), and 3/(3d² − R²) outside,
    // approximate the mean of 1/distance² over the sphere. The mean of the clamped cosine at the centre is 1/4.
    if (!(squared > squared_radius * (1 + distance_slack))) {
        const double cosine = at.normal && radius > 0.0
                                  ? -glm::dot(from_centre, glm::dvec3(*at.normal)) / (radius * (1 + distance_slack))
                                  : 1.0;
        return intensity * std::max((1 + cosine) * (1 + cosine) / 4, least_cosine_at_horizon) * 3 /
               (squared_radius + squared);
    }
    const double distance = std::sqrt(squared), sine = radius / distance;
    const double cosine_at_lamp = cone.greatest_cosine(from_centre / distance, std::sqrt(1 - sine * sine), sine);
    if (!(cosine_at_lamp > 0.0)) return 0.0;
    double cosine_at_receiver = at.normal ? mean_cosine(sphere, at) : 1.0;
    // Where the horizon cuts the sphere, the mean is less than the sine, and no cosine exceeds twice the sine.
    if (cosine_at_receiver > 0.0 && cosine_at_receiver < sine)
        cosine_at_receiver = std::max(cosine_at_receiver, std::min(least_cosine_at_horizon, 2 * sine));
    return intensity * cosine_at_lamp * cosine_at_receiver * 3 / (3 * squared - squared_radius);
}

// Assumes that the cosines from c − s to c + s, with s = r/d, are equally frequent. s is slightly enlarged, so that
// rounding never returns 0 for a visible sphere.
double mean_cosine(const BoundingSphere& sphere, const LightReceiver& at) {
    const glm::vec3 offset = sphere.centre - at.p;
    const auto distance = static_cast<double>(glm::length(offset)), radius = static_cast<double>(sphere.radius);
    if (!(distance > radius)) return 1.0;
    const double c = static_cast<double>(glm::dot(offset, *at.normal)) / distance, s = 1.0001 * radius / distance;
    if (c >= s) return c;
    return c > -s ? (c + s) * (c + s) / (4 * s) : 0.0;
}

}  // namespace phasetree::tracer
