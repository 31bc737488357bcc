#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace phasetree {

/// v at length 1, or the zero vector if v is zero. A vector whose length is 1 to within 10⁻⁶ stays as it is to the last
/// bit, so that a tree that is written and read again is the same. The length is computed in double precision: squares
/// of floats below 10⁻¹⁹ are subnormal or zero, and those above 10¹⁹ are infinite. Coordinates that would be subnormal
/// are zero, as numbers that are read are.
inline glm::vec3 unit_vector(const glm::vec3& v) {
    const glm::dvec3 exact(v);
    const double length = glm::length(exact);
    if (!(length > 0) || std::abs(length - 1) <= 1e-6) return v;
    glm::vec3 unit(exact / length);
    for (int i = 0; i < 3; ++i)
        if (std::fpclassify(unit[i]) == FP_SUBNORMAL) unit[i] = 0;
    return unit;
}

}  // namespace phasetree
