#pragma once

#include <span>

#include "phasetree/program/batch.hpp"

namespace phasetree::evaluation {

/// The values of a program's instructions at one point, as left by a kernel in one lane of their registers.
struct ValuesAtPoint {
    const BatchOfFloats* registers;
    std::span<const std::uint32_t> slot;
    std::size_t lane;

    float operator[](std::size_t instruction) const { return registers[slot[instruction]].lane[lane]; }
};

}  // namespace phasetree::evaluation
