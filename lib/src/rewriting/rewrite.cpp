#include "rewriting/rewrite.hpp"

#include <bit>

namespace phasetree::rewriting {

using program::operands;

namespace {

Op mirrored(Op op) {
    return op == Op::minimum ? Op::maximum : Op::minimum;
}

/// Whether an instruction's data are one constant, whatever its index is.
bool has_one_constant(Op op) {
    switch (op) {
        case Op::add_constant:
        case Op::constant_minus:
        case Op::multiply_constant:
        case Op::smooth_minimum:
        case Op::guarded:
        case Op::falloff:
            return true;
        default:
            return false;
    }
}

bool is_commutative(Op op) {
    return op == Op::minimum || op == Op::maximum || op == Op::add || op == Op::corner;
}

/// Whether an operation has data; of others the index means nothing.
bool has_data(Op op) {
    return has_one_constant(op) || op >= Op::first_primitive;
}

}  // namespace

Rewriter::Rewriter(std::span<const float> constants, std::size_t instructions, Arena& scratch, std::vector<float>* more)
    : constants_(constants.data()), more_(more) {
    const std::size_t most = 3 * instructions + 2;  // each may need its operands negated
    code_ = scratch.take<Instruction>(most);
    lipschitz_ = scratch.take<float>(most);
    twin_ = scratch.take<std::uint32_t>(most);
    known_ = scratch.take<std::uint32_t>(std::bit_ceil(most + 1));  // mostly a third of it is used
    std::ranges::fill(known_, 0u);
    code_[0] = {};
    lipschitz_[0] = 1;
    twin_[0] = 0;
    size_ = 1;
}

SignedValue Rewriter::append(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t data, float lipschitz) {
    code_[size_] = {op, a, b, data};
    lipschitz_[size_] = lipschitz;
    twin_[size_] = 0;
    return {static_cast<std::uint32_t>(size_++), false};
}

SignedValue Rewriter::emit(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t data, float lipschitz) {
    // Of a primitive of the input there is but one, unless nobody has looked yet.
    if (op >= Op::first_primitive && a == 0 && !more_) return append(op, a, b, data, lipschitz);
    const bool is_constant = has_one_constant(op), is_index = has_data(op);
    const auto content = [&](std::uint32_t index) {
        return is_constant ? std::bit_cast<std::uint32_t>(constants_[index]) : is_index ? index : 0u;
    };
    const bool is_swapped = is_commutative(op) && b < a;
    const std::uint32_t first = is_swapped ? b : a, second = is_swapped ? a : b;
    const std::uint32_t known_content = content(data);
    std::uint64_t hash = static_cast<std::uint64_t>(op) * 0x9e3779b97f4a7c15u +
                         std::uint64_t{first} * 0xbf58476d1ce4e5b9u + std::uint64_t{second} * 0x94d049bb133111ebu +
                         std::uint64_t{known_content} * 0xd6e8feb86659fd93u;
    hash ^= hash >> 32;
    for (std::size_t at = hash & (known_.size() - 1);; at = (at + 1) & (known_.size() - 1)) {
        const std::uint32_t found = known_[at];
        if (found == 0) {
            known_[at] = static_cast<std::uint32_t>(size_);
            break;
        }
        const Instruction& in = code_[found];
        const bool is_same = (in.a == a && in.b == b) || (is_commutative(op) && in.a == b && in.b == a);
        if (in.op == op && is_same && content(in.data) == known_content) return {found, false};
    }
    return append(op, a, b, data, lipschitz);
}

/// −v as a value: of a sum with a constant by the other kind of sum, if constants may be added.
std::uint32_t Rewriter::negated(std::uint32_t v) {
    if (twin_[v]) return twin_[v];
    const Instruction in = code_[v];
    const float l = lipschitz_[v];
    std::uint32_t n = 0;
    if (more_ && (in.op == Op::add_constant || in.op == Op::constant_minus)) {
        more_->push_back(-constants_[in.data]);
        const Op other = in.op == Op::add_constant ? Op::constant_minus : Op::add_constant;
        n = emit(other, in.a, 0, static_cast<std::uint32_t>(more_->size() - 1), l).id();
    } else {
        n = emit(Op::negate, v, 0, 0, l).id();
    }
    twin_[v] = n;
    twin_[n] = v;
    return n;
}

/// Of a value and its twin the one that was there first.
SignedValue Rewriter::canonical(const SignedValue& v) const {
    const std::uint32_t twin = twin_[v.id()];
    return twin && twin < v.id() ? SignedValue{twin, !v.is_negative()} : v;
}

/// The operands of a value that is the minimum, or maximum, of two.
std::optional<Rewriter::Pair> Rewriter::operands_if(Op op, const SignedValue& v) const {
    const Instruction& in = code_[v.id()];
    if (in.op != (v.is_negative() ? mirrored(op) : op)) return std::nullopt;
    return Pair{canonical({in.a, v.is_negative()}), canonical({in.b, v.is_negative()})};
}

SignedValue Rewriter::extremum(Op op, SignedValue a, SignedValue b, float lipschitz, bool is_sign_enough) {
    for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
        const auto same = operands_if(op, b);
        if (same && (same->a == a || same->b == a)) return b;
        const auto inner = operands_if(mirrored(op), b);
        if (!inner) continue;
        if (inner->a == a || inner->b == a) return a;
        if (is_sign_enough && (inner->a == -a || inner->b == -a)) b = inner->a == -a ? inner->b : inner->a;
    }
    if (a == b) return a;
    if (a == -b) return {emit(Op::absolute, a.id(), 0, 0, lipschitz).id(), op == Op::minimum};
    const bool is_negative = a.is_negative() == b.is_negative() ? a.is_negative()
                                                                : twin_[(a.is_negative() ? a : b).id()] == 0 &&
                                                                      twin_[(a.is_negative() ? b : a).id()] != 0;
    if (!is_negative) return emit(op, plain(a), plain(b), 0, lipschitz);
    return -emit(mirrored(op), plain(-a), plain(-b), 0, lipschitz);
}

SignedValue Rewriter::write(Op op, const SignedValue& left, const SignedValue& right, std::uint32_t data,
                            float lipschitz, bool is_sign_enough) {
    if (op >= Op::first_primitive) return emit(op, left.id(), 0, data, lipschitz);  // points have no sign
    const SignedValue a = canonical(left), b = canonical(right);
    switch (op) {
        case Op::negate:
            return -a;
        case Op::minimum:
        case Op::maximum:
            return extremum(op, a, b, lipschitz, is_sign_enough);
        case Op::add:
        case Op::subtract: {
            // ±(|a| + |b|) or ±(|a| − |b|)
            const bool is_difference = a.is_negative() != (b.is_negative() != (op == Op::subtract));
            if (!is_difference) return {emit(Op::add, a.id(), b.id(), 0, lipschitz).id(), a.is_negative()};
            return {emit(Op::subtract, a.id(), b.id(), 0, lipschitz).id(), a.is_negative()};
        }
        case Op::add_constant:
            return emit(a.is_negative() ? Op::constant_minus : Op::add_constant, a.id(), 0, data, lipschitz);
        case Op::constant_minus:
            return emit(a.is_negative() ? Op::add_constant : Op::constant_minus, a.id(), 0, data, lipschitz);
        case Op::multiply_constant:
            return {emit(op, a.id(), 0, data, lipschitz).id(), a.is_negative()};
        case Op::absolute:
            if (code_[a.id()].op == Op::absolute) return {a.id(), false};
            return emit(op, a.id(), 0, 0, lipschitz);
        default:
            return emit(op, plain(a), plain(b), data, lipschitz);
    }
}

WorkingProgram rewrite(Program& program, Arena& arena) {
    const std::size_t n = program.instructions.size();
    program.constants.reserve(program.constants.size() + n);
    Rewriter rewriter(program.constants, n, arena, &program.constants);
    const std::span<SignedValue> written = arena.take<SignedValue>(n);
    written[0] = {};
    for (std::size_t i = 1; i < n; ++i) {
        const Instruction& in = program.instructions[i];
        written[i] =
            rewriter.write(in.op, operands(in.op) > 0 ? written[in.a] : SignedValue{},
                           operands(in.op) > 1 ? written[in.b] : SignedValue{}, in.data, program.lipschitz[i], false);
    }
    const std::span<ProgramOutput> outputs = arena.take<ProgramOutput>(program.outputs.size());
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        const SignedValue& v = written[program.outputs[k].value];
        outputs[k] = {program.outputs[k].phase, v.id(), v.is_negative()};
    }
    return {rewriter.code(), rewriter.lipschitz(), outputs};
}

}  // namespace phasetree::rewriting
