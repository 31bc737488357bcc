#pragma once

#include <cstddef>
#include <vector>

namespace phasetree {

/// Disjoint sets of the numbers 0 … n − 1, which can be joined (union-find). The root of a set is its smallest member.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t n) {
        parent_.reserve(n);
        while (parent_.size() < n) parent_.push_back(parent_.size());
    }

    std::size_t root(std::size_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        a = root(a);
        b = root(b);
        parent_[a < b ? b : a] = a < b ? a : b;
    }

  private:
    std::vector<std::size_t> parent_;
};

}  // namespace phasetree
