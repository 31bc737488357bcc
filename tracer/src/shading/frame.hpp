// An orthonormal frame around a unit normal: local z is the normal.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "phasetree_support/orthonormal_basis.hpp"

namespace phasetree::tracer {

class Frame {
  public:
    explicit Frame(const glm::vec3& normal) : normal_(normal), basis_(normal) {}

    glm::vec3 to_local(const glm::vec3& world) const {
        return {glm::dot(world, basis_.tangent), glm::dot(world, basis_.bitangent), glm::dot(world, normal_)};
    }
    glm::vec3 to_world(const glm::vec3& local) const {
        return local.x * basis_.tangent + local.y * basis_.bitangent + local.z * normal_;
    }
    const glm::vec3& normal() const { return normal_; }

  private:
    glm::vec3 normal_;
    support::OrthonormalBasis<glm::vec3> basis_;
};

}  // namespace phasetree::tracer
