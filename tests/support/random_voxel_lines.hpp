// Lines through cubes with random phases: the worst case for meshing, which no real object reaches.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "phasetree/meshing/phase_mesh.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

/// A cube from −1 to 1 of this many voxels per side, each with a random phase.
struct RandomVoxels {
    double side;
    int phases;
    std::uint64_t seed;

    Phase at(const glm::dvec3& p) const {
        if (std::abs(p.x) > 1 || std::abs(p.y) > 1 || std::abs(p.z) > 1) return vacuum;
        const glm::ivec3 n = glm::ivec3(glm::floor(p / side));
        std::uint64_t number = seed;
        for (int i = 0; i < 3; ++i) number = number * 1'000'003 + static_cast<std::uint64_t>(n[i] + 1000);
        Random rng(number);
        return Phase{static_cast<std::uint8_t>(rng.below(phases))};
    }
    /// Normals are those of the voxels' faces, plus `tilt`.
    LineTracer lines(const glm::vec3& tilt = glm::vec3(0)) const {
        return [*this, tilt](const glm::vec3& origin, const glm::vec3& direction, float length,
                             std::vector<CrossingOnLine>& found) {
            Phase phase = vacuum;
            for (double t = 0; t < static_cast<double>(length); t += 0.01 * side) {
                const Phase next = at(glm::dvec3(origin) + t * glm::dvec3(direction));
                if (next != phase)
                    found.push_back({static_cast<float>(t), phase, next, glm::normalize(direction + tilt)});
                phase = next;
            }
        };
    }
};

}  // namespace phasetree::tests
