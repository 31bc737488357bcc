// Numbers at voxels as the density of a medium: values are within their bounds, and ways through it end.
#pragma once

#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "fuzz/target.hpp"
#include "media/voxel_density.hpp"

namespace phasetree::fuzz {

inline void walk_density(VoxelGrid grid) {
    try {
        const tracer::VoxelDensity density(std::move(grid), {});
        const Bounds& box = density.bounds();
        const glm::vec3 from = box.low - 0.1f * box.extent(), to = box.high + 0.07f * box.extent();
        const float length = glm::length(to - from);
        if (!(length > 0.0f)) return;
        auto stretches = density.stretches({from, (to - from) / length, length});
        float last = 0.0f;
        // No more than blocks along the three axes.
        for (int count = 0; const auto stretch = stretches.next(); ++count) {
            promised(count < 4 * VoxelGrid::max_along_axis, "a way through voxels ends");
            promised(stretch->from >= last && stretch->to > stretch->from, "stretches follow each other");
            promised(stretch->bound > 0.0f && stretch->bound <= 1.0f, "bounds are shares");
            last = stretch->to;
        }
        for (int i = 0; i < 8; ++i) {
            const float value = density.at(from + (static_cast<float>(i) / 7) * (to - from));
            promised(value >= 0.0f && value <= 1.0001f, "densities are shares of the greatest");
        }
    } catch (const std::invalid_argument&) {
    }
}

}  // namespace phasetree::fuzz
