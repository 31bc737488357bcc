// An orthonormal frame around a unit normal: local z is the normal.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "phasetree_support/orthonormal_basis.hpp"

namespace phasetree::tracer {

class Frame {
  public:
    explicit Frame(const glm::vec3& normal) : normal_(normal), basis_(normal) {}
    /// Local x is the projection of `along`, which may have any length. If the projection vanishes, this is the frame
    /// of the other constructor.
    Frame(const glm::vec3& normal, const glm::vec3& along) : Frame(normal) {
        const auto projected = [&](const glm::vec3& v) { return v - glm::dot(v, normal) * normal; };
        const glm::vec3 x = projected(along);
        if (!(glm::dot(x, x) > least_projection * glm::dot(along, along))) return;
        // Project again: for a short projection, rounding leaves a component along the normal.
        basis_.tangent = glm::normalize(projected(glm::normalize(x)));
        basis_.bitangent = glm::cross(normal, basis_.tangent);
    }

    glm::vec3 to_local(const glm::vec3& world) const {
        return {glm::dot(world, basis_.tangent), glm::dot(world, basis_.bitangent), glm::dot(world, normal_)};
    }
    glm::vec3 to_world(const glm::vec3& local) const {
        return local.x * basis_.tangent + local.y * basis_.bitangent + local.z * normal_;
    }
    const glm::vec3& normal() const { return normal_; }

  private:
    // Square of the sine below which a projection is mostly rounding error.
    static constexpr float least_projection = 1e-8f;

    glm::vec3 normal_;
    support::OrthonormalBasis<glm::vec3> basis_;
};

}  // namespace phasetree::tracer
