#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "phasetree/model/from_file.hpp"

namespace phasetree {

/// Balls read from a file. Radii and phases are either empty or have one entry per centre. A phase is an index into a
/// list outside the file.
struct BallList {
    /// The maximum that file readers and nodes accept. The hierarchy over the balls stores counts and indices as
    /// floats, which are exact up to 2²⁴.
    static constexpr std::size_t max_balls = 16'000'000;

    std::vector<glm::vec3> centres;
    std::vector<float> radii;
    std::vector<std::uint8_t> phases;

    std::size_t bytes() const {
        return centres.size() * sizeof(centres[0]) + radii.size() * sizeof(radii[0]) + phases.size();
    }
};

template <>
struct FileFormat<BallList> {
    static BallList read(const std::filesystem::path&);
};

}  // namespace phasetree
