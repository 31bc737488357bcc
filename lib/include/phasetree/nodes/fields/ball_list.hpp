#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace phasetree {

/// Balls as files give them. Radii and phases are empty, or have an entry for each centre; a phase is the number of an
/// entry in a list that the file does not hold.
struct BallList {
    /// Readers and nodes accept at most this many: the hierarchy over them counts its nodes in floats, which are exact
    /// up to 2²⁴.
    static constexpr std::size_t most_balls = 16'000'000;

    std::vector<glm::vec3> centres;
    std::vector<float> radii;
    std::vector<std::uint8_t> phases;

    std::size_t bytes() const {
        return centres.size() * sizeof(centres[0]) + radii.size() * sizeof(radii[0]) + phases.size();
    }
};

}  // namespace phasetree
