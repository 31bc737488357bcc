#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <unordered_map>

#include "phasetree/nodes/phased/label_grid.hpp"

namespace phasetree::tracer {

// Appends voxels to a grid in its storage order, and adds each new number to the list.
class LabelNumbers {
  public:
    explicit LabelNumbers(LabelGrid& grid) : grid_(grid) {}

    std::uint8_t index_of(std::int32_t number) {
        if (number == last_ && !grid_.numbers.empty()) return last_index_;
        const auto [at, is_new] = indices_.emplace(number, static_cast<std::uint8_t>(grid_.numbers.size()));
        if (is_new) {
            if (grid_.numbers.size() == LabelGrid::max_numbers)
                throw std::runtime_error(fmt::format("it has more than {} different numbers", LabelGrid::max_numbers));
            grid_.numbers.push_back(number);
        }
        last_ = number;
        last_index_ = at->second;
        return last_index_;
    }

  private:
    LabelGrid& grid_;
    std::unordered_map<std::int32_t, std::uint8_t> indices_;
    std::int32_t last_ = 0;
    std::uint8_t last_index_ = 0;
};

// Throws std::runtime_error if there are more voxels than label grids and numeric stacks may have.
inline std::size_t checked_count(const std::array<int, 3>& size) {
    std::size_t count = 1;
    for (const int n : size) {
        if (n < 1 || n > VoxelGrid::max_along_axis || count > LabelGrid::max_voxels)
            throw std::runtime_error(
                fmt::format("it has {} × {} × {} voxels; the limits are {} along an axis and {} in total", size[0],
                            size[1], size[2], VoxelGrid::max_along_axis, LabelGrid::max_voxels));
        count *= static_cast<std::size_t>(n);
    }
    if (count > LabelGrid::max_voxels)
        throw std::runtime_error(fmt::format("it has {} × {} × {} voxels; the limit is {} in total", size[0], size[1],
                                             size[2], LabelGrid::max_voxels));
    return count;
}

}  // namespace phasetree::tracer
