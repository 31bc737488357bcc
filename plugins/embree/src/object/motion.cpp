#include "object/motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace phasetree::embree {

std::optional<Placement> Placement::of(const glm::dmat3& linear, const glm::dvec3& translation) {
    // Orthogonal columns of the same lengths would have the determinant `volume`. A fraction below 1e-6 of it counts as
    // zero, because the inverse would be too inaccurate.
    const double volume = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
    const double determinant = glm::determinant(linear);
    if (!(std::abs(determinant) > 1e-6 * volume) || !std::isfinite(volume)) return std::nullopt;
    return Placement{linear, glm::inverse(linear), translation};
}

std::optional<Placement> Placement::of(const float* m) {
    glm::dmat3 linear;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) linear[column][row] = static_cast<double>(m[3 * column + row]);
    return of(linear, glm::dvec3(m[9], m[10], m[11]));
}

glm::vec3 Placement::normal(const glm::vec3& n) const {
    return glm::vec3(glm::normalize(glm::transpose(inverse) * glm::dvec3(n)));
}

std::optional<Placement> Motion::at(float time) const {
    if (steps_.empty()) return Placement{};
    const double last = static_cast<double>(steps_.size() - 1);
    const double whole = (static_cast<double>(time) - static_cast<double>(start_)) /
                         (static_cast<double>(end_) - static_cast<double>(start_)) * last;
    const double at = std::isfinite(whole) ? std::clamp(whole, 0.0, last) : 0.0;
    const std::size_t i = std::min(static_cast<std::size_t>(at), steps_.size() - 1);
    const Step& a = steps_[i];
    const Step& b = steps_[std::min(i + 1, steps_.size() - 1)];
    const double f = at - static_cast<double>(i);
    return Placement::of(a.linear * (1 - f) + b.linear * f, a.translation * (1 - f) + b.translation * f);
}

Bounds Motion::image(const Bounds& box, unsigned step) const {
    if (steps_.empty()) return box;
    const Step& s = steps_[std::min<std::size_t>(step, steps_.size() - 1)];
    const Bounds turned = image_of(box, glm::mat3(s.linear));
    const glm::vec3 shift(s.translation);
    // Enlarge the bounds by a few rounding errors of the largest coordinate, so that they contain the rounded points.
    const glm::vec3 farthest = glm::max(glm::abs(turned.low + shift), glm::abs(turned.high + shift));
    const float largest = std::max({farthest.x, farthest.y, farthest.z, glm::length(shift)});
    return Bounds{turned.low + shift, turned.high + shift}.inflated(2e-6f * largest);
}

}  // namespace phasetree::embree
