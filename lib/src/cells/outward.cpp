#include "cells/outward.hpp"

#include <unordered_map>

namespace phasetree {

namespace {

/// An old value as a new one and a sign.
struct Signed {
    std::uint32_t id = 0;
    bool is_negative = false;
};

class Mover {
  public:
    explicit Mover(Program& program) : program_(program) {}

    OutwardProgram run() {
        // By index: constants are appended on the way, instructions are not.
        for (std::uint32_t i = 0; i < program_.instructions.size(); ++i) moved_.push_back(move(i));
        for (const Output& o : program_.outputs) {
            const Signed v = moved_[o.value];
            result_.outputs.push_back({o.phase, v.id, v.is_negative});
        }
        return std::move(result_);
    }

  private:
    Signed emit(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t data, float lipschitz) {
        result_.code.push_back({op, a, b, data});
        result_.lipschitz.push_back(lipschitz);
        return {static_cast<std::uint32_t>(result_.code.size() - 1), false};
    }
    std::uint32_t constant(float c) {
        program_.constants.push_back(c);
        return static_cast<std::uint32_t>(program_.constants.size() - 1);
    }

    /// −v as a value: of a sum with a constant by the other kind of sum.
    std::uint32_t negated(std::uint32_t v) {
        if (const auto found = negated_.find(v); found != negated_.end()) return found->second;
        const Instruction in = result_.code[v];
        const float l = result_.lipschitz[v];
        std::uint32_t n = 0;
        if (in.op == Op::add_constant)
            n = emit(Op::constant_minus, in.a, 0, constant(-program_.constants[in.data]), l).id;
        else if (in.op == Op::constant_minus)
            n = emit(Op::add_constant, in.a, 0, constant(-program_.constants[in.data]), l).id;
        else
            n = emit(Op::negate, v, 0, 0, l).id;
        negated_.emplace(v, n);
        return n;
    }
    std::uint32_t plain(const Signed& v) { return v.is_negative ? negated(v.id) : v.id; }

    Signed move(std::uint32_t i) {
        const Instruction& in = program_.instructions[i];
        const float l = program_.lipschitz[i];
        const Signed a = operands(in.op) > 0 ? moved_[in.a] : Signed{},
                     b = operands(in.op) > 1 ? moved_[in.b] : Signed{};
        switch (in.op) {
            case Op::negate:
                return {a.id, !a.is_negative};
            case Op::minimum:
            case Op::maximum: {
                // Of two signs the one that costs a negation less.
                const bool is_negative = a.is_negative && b.is_negative;
                if (!is_negative) return emit(in.op, plain(a), plain(b), in.data, l);
                const Op mirrored = in.op == Op::minimum ? Op::maximum : Op::minimum;
                return {emit(mirrored, a.id, b.id, in.data, l).id, true};
            }
            case Op::add:
                if (a.is_negative == b.is_negative) return {emit(Op::add, a.id, b.id, in.data, l).id, a.is_negative};
                return a.is_negative ? emit(Op::subtract, b.id, a.id, in.data, l)
                                     : emit(Op::subtract, a.id, b.id, in.data, l);
            case Op::subtract:
                if (a.is_negative == b.is_negative)
                    return {emit(Op::subtract, a.id, b.id, in.data, l).id, a.is_negative};
                return {emit(Op::add, a.id, b.id, in.data, l).id, a.is_negative};
            case Op::add_constant:
                return emit(a.is_negative ? Op::constant_minus : Op::add_constant, a.id, 0, in.data, l);
            case Op::constant_minus:
                return emit(a.is_negative ? Op::add_constant : Op::constant_minus, a.id, 0, in.data, l);
            case Op::multiply_constant:
                return {emit(in.op, a.id, 0, in.data, l).id, a.is_negative};
            case Op::absolute:
                return emit(in.op, a.id, 0, in.data, l);
            default:
                return emit(in.op, plain(a), plain(b), in.data, l);
        }
    }

    Program& program_;
    OutwardProgram result_;
    std::vector<Signed> moved_;
    std::unordered_map<std::uint32_t, std::uint32_t> negated_;
};

}  // namespace

OutwardProgram move_negations_outward(Program& program) {
    return Mover(program).run();
}

}  // namespace phasetree
