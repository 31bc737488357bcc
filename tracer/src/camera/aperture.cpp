#include "camera/aperture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

Aperture::Aperture(const ApertureParameters& p)
    : radius_(static_cast<double>(p.lens_radius)),
      blades_(p.blades),
      rotation_(std::remainder(static_cast<double>(p.rotation_degrees), 360.0) * std::numbers::pi / 180.0) {
    if (!std::isfinite(p.lens_radius) || p.lens_radius < 0.0f)
        throw std::invalid_argument("the camera's lens radius must be a finite number and not negative");
    if (p.blades != 0 && (p.blades < 3 || p.blades > most_blades))
        throw std::invalid_argument("a lens has 3 to " + std::to_string(most_blades) + " blades, or 0 for a disk");
    if (!std::isfinite(p.rotation_degrees))
        throw std::invalid_argument("the rotation of the camera's blades must be a finite number");
}

glm::dvec2 Aperture::sample(const glm::vec2& u) const {
    if (blades_ == 0) return radius_ * glm::dvec2(square_to_uniform_disk(u));
    // u.x chooses one of the triangles between the centre and a side. Its remainder and u.y choose a point in the
    // triangle.
    const double scaled = static_cast<double>(u.x) * blades_;
    const int side = std::min(static_cast<int>(scaled), blades_ - 1);
    const double outward = std::sqrt(std::clamp(scaled - side, 0.0, 1.0));
    const auto corner = [&](int i) {
        const double angle = rotation_ + 2.0 * std::numbers::pi * i / blades_;
        return glm::dvec2(std::cos(angle), std::sin(angle));
    };
    const double along = static_cast<double>(u.y);
    return radius_ * outward * ((1.0 - along) * corner(side) + along * corner(side + 1));
}

}  // namespace phasetree::tracer
