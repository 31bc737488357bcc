#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree::embree {

/// Where an object is at one time: an affine map from its own space to the geometry's, and back.
struct Placement {
    glm::dmat3 linear{1}, inverse{1};
    glm::dvec3 translation{0};

    /// Nothing if the map has no inverse.
    static std::optional<Placement> of(const glm::dmat3& linear, const glm::dvec3& translation);
    /// From twelve floats, column by column.
    static std::optional<Placement> of(const float* columns);

    glm::vec3 point(const glm::vec3& p) const { return glm::vec3(linear * glm::dvec3(p) + translation); }
    glm::vec3 point_within(const glm::vec3& p) const { return glm::vec3(inverse * (glm::dvec3(p) - translation)); }
    glm::vec3 direction_within(const glm::vec3& d) const { return glm::vec3(inverse * glm::dvec3(d)); }
    glm::vec3 normal(const glm::vec3& n) const;
};

/// A placement for each of some time steps; between them the maps' entries are interpolated.
class Motion {
  public:
    Motion() = default;
    struct Step {
        glm::dmat3 linear{1};
        glm::dvec3 translation{0};
    };
    Motion(std::vector<Step> steps, float start, float end) : steps_(std::move(steps)), start_(start), end_(end) {}

    /// Whether there is no motion: the geometry's space is the object's own.
    bool none() const { return steps_.empty(); }
    /// Nothing if the map at that time has no inverse. A time before the start or after the end counts as that one.
    std::optional<Placement> at(float time) const;
    unsigned steps() const { return steps_.empty() ? 1 : static_cast<unsigned>(steps_.size()); }
    /// The bounds of a box's image at a time step. Bounds interpolated linearly between two steps, as Embree does it,
    /// hold the image in between, since each of its points moves linearly.
    Bounds image(const Bounds& box, unsigned step) const;

  private:
    std::vector<Step> steps_;
    float start_ = 0, end_ = 1;
};

}  // namespace phasetree::embree
