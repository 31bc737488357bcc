// An orthonormal frame around a unit normal: local z is the normal.
//
// Reference: Duff, Burgess, Christensen, Hery, Kensler, Liani & Villemin, Building an Orthonormal Basis, Revisited,
// JCGT 6(1), 2017.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

class Frame {
  public:
    explicit Frame(const glm::vec3& normal) : normal_(normal) {
        const float sign = std::copysign(1.0f, normal.z);
        const float a = -1.0f / (sign + normal.z);
        const float b = normal.x * normal.y * a;
        tangent_ = {1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
        bitangent_ = {b, sign + normal.y * normal.y * a, -normal.y};
    }

    glm::vec3 to_local(const glm::vec3& world) const {
        return {glm::dot(world, tangent_), glm::dot(world, bitangent_), glm::dot(world, normal_)};
    }
    glm::vec3 to_world(const glm::vec3& local) const {
        return local.x * tangent_ + local.y * bitangent_ + local.z * normal_;
    }
    const glm::vec3& normal() const { return normal_; }

  private:
    glm::vec3 normal_;
    glm::vec3 tangent_;
    glm::vec3 bitangent_;
};

}  // namespace phasetree::tracer
