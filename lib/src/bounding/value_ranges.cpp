#include "bounding/value_ranges.hpp"

#include "enclosure/difference.hpp"

namespace phasetree::bounding {

using enclosure::least_difference;

bool ValueRanges::is_above(std::uint32_t a, std::uint32_t b, float least, int depth) const {
    if (low(a) > high(b) + least) return true;
    const Enclosure &of_a = enclosed[a], &of_b = enclosed[b];
    const double needed = static_cast<double>(least) + 2 * margin;
    if (!(of_a.centre - of_b.centre > needed)) return false;
    if (least_difference(of_a, of_b, enclosed.half) > needed) return true;
    if (depth == 0) return false;
    const auto is_operand_above = [&](std::uint32_t x, std::uint32_t y) { return is_above(x, y, least, depth - 1); };
    const Instruction &in_a = enclosed.program.code[a], &in_b = enclosed.program.code[b];
    if (in_b.op == Op::minimum) return is_operand_above(a, in_b.a) || is_operand_above(a, in_b.b);
    if (in_a.op == Op::maximum) return is_operand_above(in_a.a, b) || is_operand_above(in_a.b, b);
    if (in_a.op == Op::minimum) return is_operand_above(in_a.a, b) && is_operand_above(in_a.b, b);
    if (in_b.op == Op::maximum) return is_operand_above(a, in_b.a) && is_operand_above(a, in_b.b);
    return false;
}

}  // namespace phasetree::bounding
