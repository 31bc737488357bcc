#pragma once

#include "phasetree/program/program.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

/// A signed reference to a value of a program: the value `id`, or minus that value. It is packed into one word, so that
/// it is read and written as a whole.
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

/// Rewrites a program in a shorter form, instruction by instruction (local value numbering with algebraic
/// simplification):
/// * Negations move outwards, from operands to results and finally into the signs of the outputs: min(−a, −b) = −max(a,
///   b), −(a + c) = −c − a, (−a)·k = −(a·k) … The operators of objects negate a lot (φ₀ = −f, a layer's −a₀ − t). In a
///   cell with a handful of instructions, every third one would otherwise be a negation.
/// * The same operation on the same operands becomes a single instruction. After pruning, what is left of several
///   objects is often equal.
/// * min(a, a) = a, max(a, −a) = |a|, min(a, max(a, b)) = a, min(a, min(a, b)) = min(a, b).
/// * Where only the sign matters, min(a, max(−a, b)) becomes min(a, b), which is as steep and nowhere nearer to zero.
/// All of these also hold with min and max exchanged. Rounding is symmetric, so values stay the same except for the
/// sign of a zero.
class Rewriter {
  public:
    /// Has room for this many calls of write(). `new_constants` is null if no constants may be added. Otherwise it is
    /// the vector viewed by `constants`; it must have spare capacity for one constant per instruction, because it must
    /// not reallocate.
    Rewriter(std::span<const float> constants, std::size_t instructions, Arena&,
             std::vector<float>* new_constants = nullptr);

    /// Writes an instruction `in` whose operands are now the values `a` and `b`. Returns its new value.
    /// `is_sign_enough` means that only the sign of this value matters.
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
    /// Appends an instruction unless an equal one exists. Returns its value.
    SignedValue emit(const Instruction&, float lipschitz);
    SignedValue write_extremum(Op, SignedValue a, SignedValue b, float lipschitz, bool is_sign_enough);
    std::uint32_t emit_negation(std::uint32_t);
    /// The index of a value equal to a signed one. Emits a negation if none exists yet.
    std::uint32_t emit_unsigned(const SignedValue& v) { return v.is_negative() ? emit_negation(v.id()) : v.id(); }
    SignedValue canonical(const SignedValue&) const;
    std::optional<Operands> operands_if(Op, const SignedValue&) const;

    const float* constants_;
    std::vector<float>* new_constants_;
    std::size_t size_ = 0;
    std::span<Instruction> code_;
    std::span<float> lipschitz_;
    std::span<std::uint32_t> negation_;  ///< for each value: the index of its negation, or 0
    std::span<std::uint32_t> table_;     ///< instructions by hash (open addressing); 0 for empty entries
};

/// Rewrites a whole program. Appends new constants to the program's.
WorkingProgram rewrite(Program&, Arena&);

}  // namespace phasetree::rewriting
