#include "phasetree/model/ray.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace phasetree {

TracedRay::TracedRay(const glm::vec3& o, const glm::vec3& d) : origin(o), direction(d) {
    const glm::dvec3 unit(d);
    inverse = 1.0 / unit;
    is_traceable = std::abs(glm::dot(unit, unit) - 1) < 1e-3 && std::isfinite(glm::dot(glm::dvec3(o), glm::dvec3(1)));
}

}  // namespace phasetree
