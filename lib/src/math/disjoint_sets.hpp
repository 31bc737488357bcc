#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace phasetree {

/// Disjoint sets of the numbers 0 … n − 1, n ≤ 2³², which can be joined (union-find). The root of a set is its smallest
/// member, whatever the order of joining.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::uint32_t{0}); }

    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        parent_[a < b ? b : a] = static_cast<std::uint32_t>(a < b ? a : b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace phasetree
