#pragma once

#include <limits>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

struct Disagreements {
    std::size_t points = 0, wrong = 0;
};

/// Compares labels in every cell at random points, a third of them on its faces. Points within the resolution of an
/// interface are skipped.
inline Disagreements compare_labels(const InterfaceCells& cells, std::size_t points_a_cell) {
    Random rng(6);  // a generator of its own, so that later objects do not depend on the number of cells
    Evaluator::Workspace w;
    Disagreements result;
    const float rounding = cells.resolution();
    const std::vector<Output>& outputs = cells.whole().program().outputs;
    std::vector<BatchOfFloats> phi(outputs.size());
    // Few cells get more points each. If there are very many, only some are tested.
    const std::size_t each = std::max(points_a_cell, 500 / std::max<std::size_t>(1, cells.size()));
    const std::size_t stride = 1 + cells.size() / (long_tests() ? 100'000 : 10'000);
    for (std::size_t i = 0; i < cells.size(); i += stride) {
        const Bounds box = cells.bounds(i);
        for (std::size_t first = 0; first < each; first += batch_size) {
            BatchOfFloats x, y, z;
            for (std::size_t lane = 0; lane < batch_size; ++lane) {
                glm::vec3 p = rng.in(box);
                if (lane % 3 == 0) {
                    const int axis = rng.below(3);
                    p[axis] = rng.chance(0.5) ? box.low[axis] : box.high[axis];
                }
                x[lane] = p.x;
                y[lane] = p.y;
                z[lane] = p.z;
            }
            cells.whole().evaluate(x, y, z, phi, w);
            for (std::size_t lane = 0; lane < std::min(batch_size, each - first); ++lane) {
                float lowest = std::numeric_limits<float>::max(), second = lowest;
                Phase label;
                for (std::size_t k = 0; k < outputs.size(); ++k) {
                    const float v = phi[k][lane];
                    second = std::min(second, std::max(v, lowest));
                    if (v < lowest) label = outputs[k].phase;
                    lowest = std::min(lowest, v);
                }
                // Also skip points where a phase meets itself: its component is zero there, so rounding decides the
                // label.
                if (second < rounding || lowest > -rounding) continue;
                ++result.points;
                if (cells.label(i, {x[lane], y[lane], z[lane]}, w) != label) ++result.wrong;
            }
        }
    }
    return result;
}

}  // namespace phasetree::tests
