#pragma once

#include "phasetree/program/program.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A value as another one and a sign: in one word, which is written and read again as a whole.
class SignedValue {
  public:
    SignedValue() = default;
    SignedValue(std::uint32_t id, bool is_negative) : word_(2 * id + (is_negative ? 1 : 0)) {}

    std::uint32_t id() const { return word_ / 2; }
    bool is_negative() const { return word_ % 2 != 0; }
    SignedValue operator-() const { return {id(), !is_negative()}; }
    bool operator==(const SignedValue&) const = default;

  private:
    std::uint32_t word_ = 0;
};

/// Writes a program anew, instruction by instruction, so that it is shorter:
/// * Negations move outward, from operand to result and in the end into the outputs' signs: min(−a, −b) = −max(a, b),
///   −(a + c) = −c − a, (−a)·k = −(a·k) … Operators of objects negate a lot (φ₀ = −f, a layer's −a₀ − t); where a
///   handful of instructions is left, every third would be a negation.
/// * The same operation on the same operands is one instruction: what pruning leaves of several objects is often equal.
/// * min(a, a) = a, max(a, −a) = |a|, min(a, max(a, b)) = a, min(a, min(a, b)) = min(a, b).
/// * Where only the sign matters, min(a, max(−a, b)) is min(a, b), which is as steep and nowhere nearer to zero.
/// All of these with min and max changed. Rounding is symmetric, so values are the same but for the sign of a zero.
class Rewriter {
  public:
    /// For so many instructions. New constants are appended to `more`, if there is such, whose memory must suffice.
    Rewriter(std::span<const float> constants, std::size_t instructions, Arena& scratch,
             std::vector<float>* more = nullptr);

    /// What an instruction of these operands' values becomes; `is_sign_enough` tells that only the sign of it matters.
    SignedValue write(Op, const SignedValue& a, const SignedValue& b, std::uint32_t data, float lipschitz,
                      bool is_sign_enough);

    std::span<const Instruction> code() const { return code_.first(size_); }
    std::span<const float> lipschitz() const { return lipschitz_.first(size_); }

  private:
    struct Pair {
        SignedValue a, b;
    };

    SignedValue append(Op, std::uint32_t a, std::uint32_t b, std::uint32_t data, float lipschitz);
    /// The same, if it is not there yet.
    SignedValue emit(Op, std::uint32_t a, std::uint32_t b, std::uint32_t data, float lipschitz);
    SignedValue extremum(Op, SignedValue a, SignedValue b, float lipschitz, bool is_sign_enough);
    std::uint32_t negated(std::uint32_t);
    std::uint32_t plain(const SignedValue& v) { return v.is_negative() ? negated(v.id()) : v.id(); }
    SignedValue canonical(const SignedValue&) const;
    std::optional<Pair> operands_if(Op, const SignedValue&) const;

    const float* constants_;
    std::vector<float>* more_;
    std::size_t size_ = 0;
    std::span<Instruction> code_;
    std::span<float> lipschitz_;
    std::span<std::uint32_t> twin_;   ///< of each value: what is minus it, or 0
    std::span<std::uint32_t> known_;  ///< a hash table of instructions, 0 where there is none
};

/// The whole of a program rewritten; constants that are new are appended to the program's.
WorkingProgram rewrite(Program&, Arena&);

}  // namespace phasetree::rewriting
