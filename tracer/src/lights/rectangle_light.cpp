#include "lights/rectangle_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "image/luminance.hpp"
#include "lights/check.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

constexpr double smallest_spherical = 1e-9;  // steradians

// The component along z, and 1 − z², of the normal of the plane through the origin and a rectangle's edge. The edge is
// parallel to one axis, at offset `side` along the other and at depth `depth`.
struct EdgeNormal {
    double z;
    double rest;
    EdgeNormal(double side, double depth, double sign) {
        const double squared = side * side + depth * depth;
        z = sign * side / std::sqrt(squared);
        rest = depth * depth / squared;
    }
};

// The unit complex number of an angle up to π.
struct Turn {
    double cosine, sine;
    friend Turn operator*(const Turn& a, const Turn& b) {
        return {a.cosine * b.cosine - a.sine * b.sine, a.cosine * b.sine + a.sine * b.cosine};
    }
};

// The inner angle between two neighbouring edge planes: cos = −z₀z₁, sin² = 1 − z₀²z₁².
Turn corner(const EdgeNormal& a, const EdgeNormal& b) {
    const double sin_squared = a.rest + b.rest - a.rest * b.rest;
    return {-a.z * b.z, std::sqrt(std::max(0.0, sin_squared))};
}

// The sum of two such angles minus π, which is in [−π, π]. Rounding does not swap the two ends of that range: near
// them, both cosines have the same sign, so the sine of the sum is a sum of two products of one sign, and its sign is
// right.
double excess(const Turn& a, const Turn& b) {
    const Turn sum = a * b;
    return portable::atan2(-sum.sine, -sum.cosine);
}

}  // namespace

// The spherical rectangle, in the frame of p: the rectangle is [x0, x1] × [y0, y1] in the plane z = −depth. b0, b1 and
// k are those of Ureña et al. 2013: the z components of the normals of the planes through p and the edges y0 and y1,
// and k = 2π − γ₂ − γ₃, where γ₂ and γ₃ are the inner angles at the ends of the edge x0. sample() uses their names fu,
// cu, xu, h0 and h1, too.
struct RectangleLight::View {
    double x0, x1, y0, y1, depth;
    double solid_angle = 0.0;
    double b0 = 0.0, b1 = 0.0, k = 0.0;
};

RectangleLight::RectangleLight(const glm::vec3& centre, const glm::vec3& edge_u, const glm::vec3& edge_v,
                               const glm::vec3& radiance, bool visible_to_camera)
    : centre_(centre), radiance_(radiance), visible_to_camera_(visible_to_camera) {
    check_point(centre, "the rectangle light's centre");
    check_point(edge_u, "the rectangle light's first edge");
    check_point(edge_v, "the rectangle light's second edge");
    check_colour(radiance, "the rectangle light's radiance");
    const glm::dvec3 u(edge_u);
    const glm::dvec3 v(edge_v);
    const double width = glm::length(u);
    const double height = glm::length(v);
    if (!(width > 0.0) || !(height > 0.0)) {
        throw std::invalid_argument("the rectangle light's edges must be longer than zero");
    }
    if (std::abs(glm::dot(u, v)) > 1e-4 * width * height) {
        throw std::invalid_argument("the rectangle light's edges must be perpendicular to each other");
    }
    axis_u_ = u / width;
    axis_n_ = glm::normalize(glm::cross(u, v));
    axis_v_ = glm::cross(axis_n_, axis_u_);
    half_u_ = 0.5 * width;
    half_v_ = 0.5 * height;
    area_ = width * height;
    disk_radius_ = std::sqrt(area_ / std::numbers::pi);
}

RectangleLight RectangleLight::facing(const glm::vec3& centre, const glm::vec3& target, float width, float height,
                                      const glm::vec3& radiance, bool visible_to_camera) {
    check_point(centre, "the rectangle light's centre");
    check_point(target, "the rectangle light's target");
    check_positive(width, "the rectangle light's width");
    check_positive(height, "the rectangle light's height");
    const glm::dvec3 towards = glm::dvec3(target) - glm::dvec3(centre);
    if (!(glm::length(towards) > 0.0)) {
        throw std::invalid_argument("the rectangle light's target must not be its centre");
    }
    const glm::dvec3 normal = glm::normalize(towards);
    const glm::dvec3 horizontal = glm::cross(glm::dvec3(0.0, 0.0, 1.0), normal);
    const glm::dvec3 u = glm::length(horizontal) > 1e-6 ? glm::normalize(horizontal) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 v = glm::normalize(glm::cross(normal, u));
    return {centre, glm::vec3(u * static_cast<double>(width)), glm::vec3(v * static_cast<double>(height)), radiance,
            visible_to_camera};
}

RectangleLight::View RectangleLight::seen_from(const glm::vec3& p) const {
    const glm::dvec3 offset = centre_ - glm::dvec3(p);
    const double x = glm::dot(offset, axis_u_);
    const double y = glm::dot(offset, axis_v_);
    View view{x - half_u_, x + half_u_, y - half_v_, y + half_v_, -glm::dot(offset, axis_n_)};
    if (!(view.depth > 0.0)) return view;
    // The edges' planes in the order y = y0, x = x1, y = y1, x = x0; the signs make all normals point outwards.
    const EdgeNormal n0(view.y0, view.depth, -1.0);
    const EdgeNormal n1(view.x1, view.depth, 1.0);
    const EdgeNormal n2(view.y1, view.depth, 1.0);
    const EdgeNormal n3(view.x0, view.depth, -1.0);
    const double below = excess(corner(n0, n1), corner(n1, n2)), above = excess(corner(n2, n3), corner(n3, n0));
    view.b0 = n0.z;
    view.b1 = n2.z;
    view.k = std::numbers::pi - above;
    view.solid_angle = below + above;
    if (!(view.solid_angle >= smallest_spherical)) {
        const double distance = glm::length(offset);
        view.solid_angle = area_ * view.depth / (distance * distance * distance);
        view.solid_angle = std::min(view.solid_angle, 0.999 * smallest_spherical);
    }
    return view;
}

double RectangleLight::solid_angle(const glm::vec3& p) const {
    return seen_from(p).solid_angle;
}

// A cos θ/d² far away, 2π close by. r, the radius of a disk of the same area, is the scale between the two.
double RectangleLight::approximate_solid_angle(const glm::vec3& p) const {
    const glm::dvec3 offset = centre_ - glm::dvec3(p);
    const double depth = -glm::dot(offset, axis_n_);
    if (!(depth > 0.0)) return 0.0;
    const double squared = glm::dot(offset, offset), r = disk_radius_;
    const double cosine = (depth + r) / (std::sqrt(squared) + r);
    return area_ * cosine / (squared + 0.5 * r * r);
}

EmissionBounds RectangleLight::emission_bounds() const {
    return {bounding_sphere(), static_cast<double>(luminance(radiance_)) * area_, EmissionCone::of_plane(axis_n_)};
}

DirectionSample RectangleLight::sample(const glm::vec3& p, const glm::vec2& u) const {
    const View view = seen_from(p);
    double x = 0.0;
    double y = 0.0;
    if (view.solid_angle < smallest_spherical) {
        x = view.x0 + static_cast<double>(u.x) * (view.x1 - view.x0);
        y = view.y0 + static_cast<double>(u.y) * (view.y1 - view.y0);
    } else {
        const double angle = static_cast<double>(u.x) * view.solid_angle + view.k;
        const double fu = (std::cos(angle) * view.b0 - view.b1) / std::sin(angle);
        const double cu = std::clamp(std::copysign(1.0 / std::sqrt(fu * fu + view.b0 * view.b0), fu), -1.0, 1.0);
        const double xu = cu * view.depth / std::sqrt(std::max(1e-300, 1.0 - cu * cu));
        x = std::clamp(xu, view.x0, view.x1);
        const double d = std::sqrt(x * x + view.depth * view.depth);
        const double h0 = view.y0 / std::sqrt(d * d + view.y0 * view.y0);
        const double h1 = view.y1 / std::sqrt(d * d + view.y1 * view.y1);
        const double h = h0 + static_cast<double>(u.y) * (h1 - h0);
        y = std::clamp(h * d / std::sqrt(std::max(1e-300, 1.0 - h * h)), view.y0, view.y1);
    }
    const glm::dvec3 towards = x * axis_u_ + y * axis_v_ - view.depth * axis_n_;
    const double distance = glm::length(towards);
    return {towards / distance, static_cast<float>(density(view, distance, view.depth / distance))};
}

double RectangleLight::density(const View& view, double distance, double cosine) const {
    return view.solid_angle >= smallest_spherical ? 1.0 / view.solid_angle : distance * distance / (area_ * cosine);
}

float RectangleLight::pdf_at(const glm::vec3& p, const glm::vec3& direction, float distance) const {
    const double cosine = -glm::dot(glm::dvec3(direction), axis_n_);
    return static_cast<float>(density(seen_from(p), static_cast<double>(distance), cosine));
}

std::optional<float> RectangleLight::intersect(const glm::vec3& origin, const glm::vec3& direction) const {
    const glm::dvec3 d(direction);
    const double approach = -glm::dot(d, axis_n_);
    if (!(approach > 0.0)) return std::nullopt;
    const glm::dvec3 offset = centre_ - glm::dvec3(origin);
    const double depth = -glm::dot(offset, axis_n_);
    if (!(depth > 0.0)) return std::nullopt;
    const double distance = depth / approach;
    const glm::dvec3 from_centre = distance * d - offset;
    if (!(std::abs(glm::dot(from_centre, axis_u_)) <= half_u_)) return std::nullopt;
    if (!(std::abs(glm::dot(from_centre, axis_v_)) <= half_v_)) return std::nullopt;
    return static_cast<float>(distance);
}

SurfacePoint RectangleLight::surface_point(const glm::vec2& u) const {
    const double x = (2.0 * static_cast<double>(u.x) - 1.0) * half_u_,
                 y = (2.0 * static_cast<double>(u.y) - 1.0) * half_v_;
    return {glm::vec3(centre_ + x * axis_u_ + y * axis_v_), normal()};
}

}  // namespace phasetree::tracer
