#pragma once

#include "phasetree/program/program.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A value of a program with a sign: the value `id`, or minus that. It is packed into one word, so that it is written
/// and read again as a whole.
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

/// Writes a program again, instruction by instruction, in a shorter form (local value numbering with algebraic
/// simplification):
/// * Negations move outward, from operands to results and finally into the outputs' signs: min(−a, −b) = −max(a, b),
///   −(a + c) = −c − a, (−a)·k = −(a·k) … The operators of objects negate a lot (φ₀ = −f, a layer's −a₀ − t); in a cell
///   with a handful of instructions every third would be a negation.
/// * The same operation on the same operands becomes one instruction. What pruning leaves of several objects is often
///   equal.
/// * min(a, a) = a, max(a, −a) = |a|, min(a, max(a, b)) = a, min(a, min(a, b)) = min(a, b).
/// * Where only the sign matters, min(a, max(−a, b)) becomes min(a, b), which is as steep and nowhere nearer to zero.
/// All of these also hold with min and max exchanged. Rounding is symmetric, so values stay the same except for the
/// sign of a zero.
class Rewriter {
  public:
    /// Has room for this many calls of write(). `new_constants` is null if no constants may be added; otherwise it is
    /// the vector behind `constants`, and it must have capacity for one more per instruction, since it may not move.
    Rewriter(std::span<const float> constants, std::size_t instructions, Arena&,
             std::vector<float>* new_constants = nullptr);

    /// Writes an instruction `in`, whose operands are now the values `a` and `b`, and returns what its value is now.
    /// `is_sign_enough` says that only the sign of this value matters.
    SignedValue write(const Instruction& in, const SignedValue& a, const SignedValue& b, float lipschitz,
                      bool is_sign_enough);

    std::span<const Instruction> code() const { return code_.first(size_); }
    std::span<const float> lipschitz() const { return lipschitz_.first(size_); }

  private:
    struct Operands {
        SignedValue a, b;
    };

    /// Appends an instruction.
    SignedValue append(const Instruction&, float lipschitz);
    /// Appends an instruction unless an equal one is there, and returns the value of that.
    SignedValue emit(const Instruction&, float lipschitz);
    SignedValue write_extremum(Op, SignedValue a, SignedValue b, float lipschitz, bool is_sign_enough);
    std::uint32_t emit_negation(std::uint32_t);
    /// The number of a value that is equal to a signed one; a negation is emitted where there is none yet.
    std::uint32_t emit_unsigned(const SignedValue& v) { return v.is_negative() ? emit_negation(v.id()) : v.id(); }
    SignedValue canonical(const SignedValue&) const;
    std::optional<Operands> operands_if(Op, const SignedValue&) const;

    const float* constants_;
    std::vector<float>* new_constants_;
    std::size_t size_ = 0;
    std::span<Instruction> code_;
    std::span<float> lipschitz_;
    std::span<std::uint32_t> negation_;  ///< for each value the number of the value that is minus it, or 0
    std::span<std::uint32_t> table_;     ///< instructions by their hash (open addressing); 0 where there is none
};

/// The whole of a program rewritten. New constants are appended to the program's.
WorkingProgram rewrite(Program&, Arena&);

}  // namespace phasetree::rewriting
