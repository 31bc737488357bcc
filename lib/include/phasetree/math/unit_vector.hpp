#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace phasetree {

/// v scaled to length 1, or the zero vector if v is zero.
///
/// A vector whose length is within 10⁻⁶ of 1 is returned unchanged, so that writing and reading a tree preserves it to
/// the last bit. The length is computed in double precision, because squares of floats below 10⁻¹⁹ are subnormal or
/// zero, and those above 10¹⁹ are infinite. Subnormal coordinates of a scaled vector become zero, as they do when
/// numbers are read.
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
