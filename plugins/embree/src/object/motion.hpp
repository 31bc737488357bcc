#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree::embree {

/// The placement of an object at one time: an affine map from object space to geometry space, and its inverse.
struct Placement {
    glm::dmat3 linear{1}, inverse{1};
    glm::dvec3 translation{0};

    /// nullopt if the map is not invertible.
    static std::optional<Placement> of(const glm::dmat3& linear, const glm::dvec3& translation);
    /// From twelve floats in column-major order.
    static std::optional<Placement> of(const float* columns);

    glm::vec3 point(const glm::vec3& p) const { return glm::vec3(linear * glm::dvec3(p) + translation); }
    glm::vec3 point_within(const glm::vec3& p) const { return glm::vec3(inverse * (glm::dvec3(p) - translation)); }
    glm::vec3 direction_within(const glm::vec3& d) const { return glm::vec3(inverse * glm::dvec3(d)); }
    glm::vec3 normal(const glm::vec3& n) const;
};

/// One placement per time step; the maps' entries are interpolated in between.
class Motion {
  public:
    Motion() = default;
    struct Step {
        glm::dmat3 linear{1};
        glm::dvec3 translation{0};
    };
    Motion(std::vector<Step> steps, float start, float end) : steps_(std::move(steps)), start_(start), end_(end) {}

    /// Whether there is no motion, so that geometry space is object space.
    bool none() const { return steps_.empty(); }
    /// nullopt if the map at that time is not invertible. Times before the start or after the end are clamped.
    std::optional<Placement> at(float time) const;
    unsigned steps() const { return steps_.empty() ? 1 : static_cast<unsigned>(steps_.size()); }
    /// The bounds of a box's image at a time step. Linear interpolation of the bounds between two steps, as Embree does
    /// it, contains the image in between, because each point of the image moves linearly.
    Bounds image(const Bounds& box, unsigned step) const;

  private:
    std::vector<Step> steps_;
    float start_ = 0, end_ = 1;
};

}  // namespace phasetree::embree
