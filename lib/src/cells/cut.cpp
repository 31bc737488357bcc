#include "cells/cut.hpp"

#include <array>

#include "cells/nearly_linear.hpp"

namespace phasetree {

namespace {

class Cutter {
  public:
    Cutter(const Bounds& box, const WorkingProgram& program, std::span<const float> constants,
           const Enclosure* registers, std::span<const std::uint32_t> slot, float rounding, Arena& scratch)
        : program_(program),
          constants_(constants),
          registers_(registers),
          slot_(slot),
          middle_(box.centre()),
          linear_(scratch.take<Linear>(program.code.size())) {
        const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
        half_ = {half.x, half.y, half.z};
        const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
        margin_ = 3 * rounding + 2e-6f * std::max({farthest.x, farthest.y, farthest.z});
        std::ranges::fill(linear_, Linear{});
    }

    /// Where sign · (v − τ) ≤ 0 may hold.
    Bounds side(std::uint32_t v, float sign, float tau, const Bounds& box) {
        const auto [low, high] = range(v);
        const bool is_below = sign > 0;
        if (box.empty() || (is_below ? low > tau + margin_ : high < tau - margin_)) return {};
        if (is_below ? high < tau - margin_ : low > tau + margin_) return box;
        const Instruction& in = program_.code[v];
        if (steps_ >= most_steps) return box;
        ++steps_;
        switch (in.op) {
            case Op::minimum:
            case Op::farther_inside:
                return is_below ? either(in, sign, tau, box) : both(in, sign, tau, box);
            case Op::maximum:
            case Op::farther:
                return is_below ? both(in, sign, tau, box) : either(in, sign, tau, box);
            case Op::corner:
                // Up to 0 it is the maximum; above, no less than each.
                if (is_below) return both(in, sign, tau, box);
                return tau <= 0 ? either(in, sign, tau, box) : box;
            case Op::smooth_minimum:
                // No more than each.
                return half_space(v, sign, tau, is_below ? box : both(in, sign, tau, box));
            case Op::negate:
                return side(in.a, -sign, -tau, box);
            case Op::add_constant:
                return side(in.a, sign, tau - constant(in), box);
            case Op::constant_minus:
                return side(in.a, -sign, constant(in) - tau, box);
            case Op::multiply_constant:
                if (constant(in) == 0) return box;
                return side(in.a, constant(in) > 0 ? sign : -sign, tau / constant(in), box);
            case Op::absolute:
                if (is_below) return side(in.a, -1, -tau, side(in.a, 1, tau, box));
                return unite(side(in.a, -1, tau, box), side(in.a, 1, -tau, box));
            default:
                return half_space(v, sign, tau, box);
        }
    }

    /// Where v = τ may hold.
    Bounds level(std::uint32_t v, float tau, const Bounds& box) {
        const auto [low, high] = range(v);
        if (box.empty() || low > tau + margin_ || high < tau - margin_) return {};
        const Instruction& in = program_.code[v];
        if (steps_ >= most_steps) return box;
        ++steps_;
        switch (in.op) {
            case Op::farther_inside:
            case Op::farther:
                if (tau == 0) return level(in.a, 0, box);
                return level_of_either(in, in.op == Op::farther ? 1 : -1, tau, box);
            case Op::minimum:
                return level_of_either(in, -1, tau, box);
            case Op::maximum:
                return level_of_either(in, 1, tau, box);
            case Op::corner:
                return tau <= 0 ? level_of_either(in, 1, tau, box) : slab(v, tau, both(in, 1, tau, box));
            case Op::smooth_minimum:
                return slab(v, tau, both(in, -1, tau, box));
            case Op::negate:
                return level(in.a, -tau, box);
            case Op::add_constant:
                return level(in.a, tau - constant(in), box);
            case Op::constant_minus:
                return level(in.a, constant(in) - tau, box);
            case Op::multiply_constant:
                return constant(in) == 0 ? box : level(in.a, tau / constant(in), box);
            case Op::absolute:
                return unite(level(in.a, tau, box), level(in.a, -tau, box));
            default:
                return slab(v, tau, box);
        }
    }

  private:
    /// A linear bound, about the box's middle. Without one its slack is infinite, or not a number.
    struct Linear {
        bool is_found = false;
        glm::vec3 normal{}, per_slope{};  ///< 1 / |normal|, 0 where that is too much
        float at_middle = 0, slack = 0;
    };

    std::array<float, 2> range(std::uint32_t v) const {
        const Range& r = registers_[slot_[v]].value;
        return {static_cast<float>(r.low), static_cast<float>(r.high)};
    }
    float constant(const Instruction& in) const { return constants_[in.data]; }
    Bounds both(const Instruction& in, float sign, float tau, const Bounds& box) {
        return side(in.b, sign, tau, side(in.a, sign, tau, box));
    }
    Bounds either(const Instruction& in, float sign, float tau, const Bounds& box) {
        return unite(side(in.a, sign, tau, box), side(in.b, sign, tau, box));
    }
    /// Where one operand is τ and the other, times the sign, no larger.
    Bounds level_of_either(const Instruction& in, float sign, float tau, const Bounds& box) {
        return unite(level(in.a, tau, side(in.b, sign, tau, box)), level(in.b, tau, side(in.a, sign, tau, box)));
    }
    Bounds slab(std::uint32_t v, float tau, const Bounds& box) {
        return half_space(v, -1, tau, half_space(v, 1, tau, box));
    }

    /// What the linear bound leaves of a box where sign · (v − τ) ≤ 0, if the other axes take what they can.
    Bounds half_space(std::uint32_t v, float sign, float tau, Bounds box) {
        if (box.empty()) return {};
        Linear& f = linear_[v];
        if (!f.is_found) f = linear(registers_[slot_[v]]);
        if (!(f.slack < 1e30f)) return box;
        const glm::vec3 centre = box.centre(), width = glm::abs(f.normal) * (0.5f * box.extent());
        const float takes = width.x + width.y + width.z;
        const float least = sign * (f.at_middle - tau + glm::dot(f.normal, centre - middle_)) - f.slack;
        if (least > takes) return {};
        if (least <= -takes) return box;
        const glm::vec3 reach = ((takes - least) - width) * f.per_slope;
        for (int i = 0; i < 3; ++i) {
            if (f.per_slope[i] == 0) continue;
            if ((f.normal[i] > 0) == (sign > 0))
                box.high[i] = std::min(box.high[i], centre[i] + reach[i]);
            else
                box.low[i] = std::max(box.low[i], centre[i] - reach[i]);
        }
        return box.empty() ? Bounds() : box;
    }
    Linear linear(const Enclosure& e) const {
        const NearlyLinear known(e, half_);
        Linear f{true};
        for (int i = 0; i < 3; ++i) {
            f.normal[i] = static_cast<float>(known.normal[static_cast<std::size_t>(i)]);
            f.per_slope[i] = std::abs(f.normal[i]) < 1e-3f ? 0 : 1 / std::abs(f.normal[i]);
        }
        f.at_middle = static_cast<float>(known.at_centre);
        f.slack = static_cast<float>(known.slack) * (1 + 1e-6f) + margin_;
        return f;
    }

    static constexpr int most_steps = 200;

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Enclosure* registers_;
    std::span<const std::uint32_t> slot_;
    glm::vec3 middle_;
    Enclosure::Vector half_{};
    float margin_ = 0;
    std::span<Linear> linear_;  ///< of a value, once it was wanted
    int steps_ = 0;
};

}  // namespace

Bounds cut_to_zero(std::uint32_t value, const Bounds& box, const Bounds& all, const WorkingProgram& program,
                   std::span<const float> constants, const Enclosure* registers, std::span<const std::uint32_t> slot,
                   float rounding, Arena& scratch) {
    const ArenaScope scope(scratch);
    return Cutter(all, program, constants, registers, slot, rounding, scratch).level(value, 0, box);
}

}  // namespace phasetree
