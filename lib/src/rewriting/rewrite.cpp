#include "rewriting/rewrite.hpp"

#include <bit>

namespace phasetree::rewriting {

using program::has_constant, program::operands;

namespace {

// Exchanges minimum and maximum.
Op opposite(Op op) {
    return op == Op::minimum ? Op::maximum : Op::minimum;
}

bool is_commutative(Op op) {
    return op == Op::minimum || op == Op::maximum || op == Op::add || op == Op::corner;
}

// Whether an operation has data. If not, the index of its data is meaningless.
bool has_data(Op op) {
    return has_constant(op) || op >= Op::first_primitive;
}

}  // namespace

Rewriter::Rewriter(std::span<const float> constants, std::size_t instructions, Arena& arena,
                   std::vector<float>* new_constants)
    : constants_(constants.data()), new_constants_(new_constants) {
    // Each instruction may take three: itself and the negations of both operands.
    const std::size_t capacity = 3 * instructions + 2;
    code_ = arena.allocate<Instruction>(capacity);
    lipschitz_ = arena.allocate<float>(capacity);
    negation_ = arena.allocate<std::uint32_t>(capacity);
    table_ = arena.allocate<std::uint32_t>(std::bit_ceil(capacity + 1));  // about a third of it is used
    std::ranges::fill(table_, 0u);
    code_[0] = {};
    lipschitz_[0] = 1;
    negation_[0] = 0;
    size_ = 1;
}

SignedValue Rewriter::append(const Instruction& in, float lipschitz) {
    code_[size_] = in;
    lipschitz_[size_] = lipschitz;
    negation_[size_] = 0;
    return {static_cast<std::uint32_t>(size_++), false};
}

SignedValue Rewriter::emit(const Instruction& in, float lipschitz) {
    // Constants may be added only when a program is rewritten for the first time. If none may be added, the program was
    // rewritten before, so each primitive of the input point occurs only once, and no lookup is needed.
    const bool was_rewritten = new_constants_ == nullptr;
    if (in.op >= Op::first_primitive && in.a == 0 && was_rewritten) return append(in, lipschitz);
    // Compare the constants themselves instead of their indices, because equal constants may have different indices.
    const bool is_constant = has_constant(in.op), is_index = has_data(in.op);
    const auto content = [&](std::uint32_t data) {
        return is_constant ? std::bit_cast<std::uint32_t>(constants_[data]) : is_index ? data : 0u;
    };
    const bool is_swapped = is_commutative(in.op) && in.b < in.a;
    const std::uint32_t first = is_swapped ? in.b : in.a, second = is_swapped ? in.a : in.b;
    const std::uint32_t own_content = content(in.data);
    std::uint64_t hash = static_cast<std::uint64_t>(in.op) * 0x9e3779b97f4a7c15u +
                         std::uint64_t{first} * 0xbf58476d1ce4e5b9u + std::uint64_t{second} * 0x94d049bb133111ebu +
                         std::uint64_t{own_content} * 0xd6e8feb86659fd93u;
    hash ^= hash >> 32;
    for (std::size_t at = hash & (table_.size() - 1);; at = (at + 1) & (table_.size() - 1)) {
        const std::uint32_t found = table_[at];
        if (found == 0) {
            table_[at] = static_cast<std::uint32_t>(size_);
            break;
        }
        const Instruction& other = code_[found];
        const bool has_same_operands =
            (other.a == in.a && other.b == in.b) || (is_commutative(in.op) && other.a == in.b && other.b == in.a);
        if (other.op == in.op && has_same_operands && content(other.data) == own_content) return {found, false};
    }
    return append(in, lipschitz);
}

// The value −v. If constants may be added, the negation of a + c is (−c) − a, and that of c − a is a + (−c).
std::uint32_t Rewriter::emit_negation(std::uint32_t v) {
    if (negation_[v]) return negation_[v];
    const Instruction in = code_[v];
    const float l = lipschitz_[v];
    std::uint32_t n = 0;
    if (new_constants_ && (in.op == Op::add_constant || in.op == Op::constant_minus)) {
        new_constants_->push_back(-constants_[in.data]);
        const Op other = in.op == Op::add_constant ? Op::constant_minus : Op::add_constant;
        n = emit({other, in.a, 0, static_cast<std::uint32_t>(new_constants_->size() - 1)}, l).id();
    } else {
        n = emit({Op::negate, v, 0, 0}, l).id();
    }
    negation_[v] = n;
    negation_[n] = v;
    return n;
}

// A value that also exists in negated form can be referenced in two ways: as itself, or as minus its negation. This
// chooses the instruction that was written first, so that equal values have equal references.
SignedValue Rewriter::canonical(const SignedValue& v) const {
    const std::uint32_t negation = negation_[v.id()];
    return negation && negation < v.id() ? SignedValue{negation, !v.is_negative()} : v;
}

// The operands of a value, if it is the minimum (or maximum) of two values.
std::optional<Rewriter::Operands> Rewriter::operands_if(Op op, const SignedValue& v) const {
    const Instruction& in = code_[v.id()];
    if (in.op != (v.is_negative() ? opposite(op) : op)) return std::nullopt;
    return Operands{canonical({in.a, v.is_negative()}), canonical({in.b, v.is_negative()})};
}

// Writes the minimum or maximum of two values.
SignedValue Rewriter::write_extremum(Op op, SignedValue a, SignedValue b, float lipschitz, bool is_sign_enough) {
    for (int turn = 0; turn < 2; ++turn, std::swap(a, b)) {
        const auto same = operands_if(op, b);
        if (same && (same->a == a || same->b == a)) return b;
        const auto inner = operands_if(opposite(op), b);
        if (!inner) continue;
        if (inner->a == a || inner->b == a) return a;
        // Here b is max(−a, c) or min(−a, c), and c replaces it.
        if (is_sign_enough && (inner->a == -a || inner->b == -a)) b = inner->a == -a ? inner->b : inner->a;
    }
    if (a == b) return a;
    // min(a, −a) is −|a|.
    if (a == -b) return {emit({Op::absolute, a.id(), 0, 0}, lipschitz).id(), op == Op::minimum};
    // If the signs differ, one operand must be negated: preferably the one whose negation already exists.
    const bool is_negative = a.is_negative() == b.is_negative() ? a.is_negative()
                                                                : negation_[(a.is_negative() ? a : b).id()] == 0 &&
                                                                      negation_[(a.is_negative() ? b : a).id()] != 0;
    if (!is_negative) {
        const std::uint32_t right = emit_unsigned(b), left = emit_unsigned(a);
        return emit({op, left, right, 0}, lipschitz);
    }
    const std::uint32_t right = emit_unsigned(-b), left = emit_unsigned(-a);
    return -emit({opposite(op), left, right, 0}, lipschitz);
}

SignedValue Rewriter::write(const Instruction& in, const SignedValue& left, const SignedValue& right, float lipschitz,
                            bool is_sign_enough) {
    if (in.op >= Op::first_primitive) return emit({in.op, left.id(), 0, in.data}, lipschitz);  // points have no sign
    const SignedValue a = canonical(left), b = canonical(right);
    switch (in.op) {
        case Op::negate:
            return -a;
        case Op::minimum:
        case Op::maximum:
            return write_extremum(in.op, a, b, lipschitz, is_sign_enough);
        case Op::add:
        case Op::subtract: {
            // The result is ±(|a| + |b|) or ±(|a| − |b|), where |a| and |b| denote the values without their signs.
            const bool is_difference = a.is_negative() != (b.is_negative() != (in.op == Op::subtract));
            const Op op = is_difference ? Op::subtract : Op::add;
            return {emit({op, a.id(), b.id(), 0}, lipschitz).id(), a.is_negative()};
        }
        case Op::add_constant:
            return emit({a.is_negative() ? Op::constant_minus : Op::add_constant, a.id(), 0, in.data}, lipschitz);
        case Op::constant_minus:
            return emit({a.is_negative() ? Op::add_constant : Op::constant_minus, a.id(), 0, in.data}, lipschitz);
        case Op::multiply_constant:
            return {emit({in.op, a.id(), 0, in.data}, lipschitz).id(), a.is_negative()};
        case Op::absolute:
            if (code_[a.id()].op == Op::absolute) return {a.id(), false};
            return emit({in.op, a.id(), 0, 0}, lipschitz);
        default: {
            const std::uint32_t second = emit_unsigned(b), first = emit_unsigned(a);
            return emit({in.op, first, second, in.data}, lipschitz);
        }
    }
}

WorkingProgram rewrite(Program& program, Arena& arena) {
    const std::size_t n = program.instructions.size();
    program.constants.reserve(program.constants.size() + n);
    Rewriter rewriter(program.constants, n, arena, &program.constants);
    const std::span<SignedValue> written = arena.allocate<SignedValue>(n);
    written[0] = {};
    for (std::size_t i = 1; i < n; ++i) {
        const Instruction& in = program.instructions[i];
        written[i] = rewriter.write(in, operands(in.op) > 0 ? written[in.a] : SignedValue{},
                                    operands(in.op) > 1 ? written[in.b] : SignedValue{}, program.lipschitz[i], false);
    }
    const std::span<ProgramOutput> outputs = arena.allocate<ProgramOutput>(program.outputs.size());
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        const SignedValue& v = written[program.outputs[k].value];
        outputs[k] = {program.outputs[k].phase, v.id(), v.is_negative()};
    }
    return {rewriter.code(), rewriter.lipschitz(), outputs};
}

}  // namespace phasetree::rewriting
