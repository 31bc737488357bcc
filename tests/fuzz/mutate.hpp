// One input becomes another: a few random changes, of bytes, of lines or of what a JSON text is made of.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fuzz/target.hpp"

namespace phasetree::fuzz {

// SplitMix64 (Steele, Lea, Flood 2014): the same sequence everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t operator()() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>((*this)() % n); }
    template <class List>
    const auto& of(const List& list) {
        return list[below(std::size(list))];
    }

  private:
    std::uint64_t state_;
};

// One change. `words` are what keys and names may become.
std::string mutated(const std::string& input, Inputs, const std::vector<std::string>& words, Random&);

}  // namespace phasetree::fuzz
