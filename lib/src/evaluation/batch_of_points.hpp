#pragma once

#include <algorithm>
#include <glm/vec3.hpp>
#include <span>

#include "phasetree/program/batch.hpp"

namespace phasetree::evaluation {

/// The coordinates of a batch of points.
struct BatchOfPoints {
    BatchOfFloats x{}, y{}, z{};

    void set(std::size_t lane, const glm::vec3& p) {
        x[lane] = p.x;
        y[lane] = p.y;
        z[lane] = p.z;
    }
    /// One to eight points. The last one also fills the remaining lanes.
    static BatchOfPoints of(std::span<const glm::vec3> points) {
        BatchOfPoints batch;
        for (std::size_t lane = 0; lane < batch_size; ++lane)
            batch.set(lane, points[std::min(lane, points.size() - 1)]);
        return batch;
    }
    /// The same point in all lanes.
    static BatchOfPoints all_at(const glm::vec3& p) {
        BatchOfPoints batch;
        batch.x.lane.fill(p.x);
        batch.y.lane.fill(p.y);
        batch.z.lane.fill(p.z);
        return batch;
    }
};

}  // namespace phasetree::evaluation
