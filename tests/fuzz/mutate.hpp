// Turns one input into another by a few random changes: of bytes, of lines, or of the elements of a JSON text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fuzz/target.hpp"
#include "phasetree_support/split_mix64.hpp"

namespace phasetree::fuzz {

// The same sequence everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}
    std::uint64_t operator()() { return generator_(); }
    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>((*this)() % n); }
    template <class List>
    const auto& of(const List& list) {
        return list[below(std::size(list))];
    }

  private:
    support::SplitMix64 generator_;
};

// Makes one change. Keys and names may be replaced by `words`.
std::string mutated(const std::string& input, Inputs, const std::vector<std::string>& words, Random&);

}  // namespace phasetree::fuzz
