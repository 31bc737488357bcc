#pragma once

/// The cells whose boxes a ray meets, in the order in which it enters them.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tests {

/// A bounding volume hierarchy over the cells in the order of their indices, in which neighbours mostly follow one
/// another: the boxes of cells, of 16 cells, and so on. Most cells are far from a ray, so this is many times faster
/// than testing all of them. A parent's box contains its children's, and floats round monotonically, so a ray that
/// meets a cell's box meets those of its parents.
class CellsAlongRay {
  public:
    struct Met {
        float enter, leave;
        std::size_t cell;
    };

    // The cells must outlive this.
    explicit CellsAlongRay(const InterfaceCells& cells) : cells_(cells) {
        std::vector<Bounds> boxes;
        for (std::size_t i = 0; i < cells.size(); ++i) boxes.push_back(cells.bounds(i));
        levels_.push_back(std::move(boxes));
        while (levels_.back().size() > 1) {
            const std::vector<Bounds>& children = levels_.back();
            std::vector<Bounds> parents((children.size() + branching - 1) / branching);
            for (std::size_t i = 0; i < children.size(); ++i) {
                Bounds& parent = parents[i / branching];
                parent = i % branching == 0 ? children[i] : unite(parent, children[i]);
            }
            levels_.push_back(std::move(parents));
        }
    }

    const InterfaceCells& cells() const { return cells_; }

    std::vector<Met> along(const glm::vec3& origin, const glm::vec3& direction) const {
        std::vector<Met> met;
        if (!levels_.front().empty()) add(levels_.size() - 1, 0, origin, direction, met);
        std::ranges::sort(met, {}, [](const Met& m) { return std::pair(m.enter, m.cell); });
        return met;
    }

  private:
    static constexpr std::size_t branching = 16;

    void add(std::size_t level, std::size_t index, const glm::vec3& p, const glm::vec3& d,
             std::vector<Met>& met) const {
        const Bounds& box = levels_[level][index];
        float enter = 0, leave = Bounds::infinity;
        for (int i = 0; i < 3; ++i) {
            const float a = (box.low[i] - p[i]) / d[i], b = (box.high[i] - p[i]) / d[i];
            enter = std::max(enter, std::min(a, b) - 1e-5f);
            leave = std::min(leave, std::max(a, b) + 1e-5f);
        }
        if (enter > leave) return;
        if (level == 0) {
            met.push_back({enter, leave, index});
            return;
        }
        const std::size_t end = std::min((index + 1) * branching, levels_[level - 1].size());
        for (std::size_t child = index * branching; child < end; ++child) add(level - 1, child, p, d, met);
    }

    const InterfaceCells& cells_;
    std::vector<std::vector<Bounds>> levels_;  // from the cells' boxes to that of all
};

}  // namespace phasetree::tests
