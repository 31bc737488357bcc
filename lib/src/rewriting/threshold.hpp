#pragma once

#include <optional>
#include <span>

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A comparison of a value with a threshold τ, moved to the value's only operand: v < τ if and only if the operand is
/// below `tau`, or above it if the operation reverses the order.
struct Threshold {
    double tau;
    bool is_reversed = false;

    /// The comparison of the operand; nullopt if the instruction is not monotone in a single operand.
    static std::optional<Threshold> of_operand(const Instruction& in, std::span<const float> constants, double tau) {
        const auto c = [&] { return static_cast<double>(constants[in.data]); };
        switch (in.op) {
            case Op::negate:
                return Threshold{-tau, true};
            case Op::add_constant:
                return Threshold{tau - c()};
            case Op::constant_minus:
                return Threshold{c() - tau, true};
            case Op::multiply_constant:
                if (c() == 0) return std::nullopt;
                return Threshold{tau / c(), c() < 0};
            default:
                return std::nullopt;
        }
    }
};

}  // namespace phasetree::rewriting
