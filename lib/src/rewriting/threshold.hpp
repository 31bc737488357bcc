#pragma once

#include <optional>
#include <span>

#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// That a value is above τ, or below, as the same of its only operand.
struct Threshold {
    double tau;
    bool is_mirrored = false;  ///< above became below

    /// Nothing if the instruction is none that keeps order or mirrors it.
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
