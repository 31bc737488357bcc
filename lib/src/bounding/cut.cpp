#include "bounding/cut.hpp"

#include <array>

#include "bounding/plane_cut.hpp"
#include "rewriting/threshold.hpp"

namespace phasetree::bounding {

using rewriting::ArenaScope, rewriting::Threshold;

namespace {

/// Where a value is, of a threshold; the threshold itself is on both sides.
enum class Side { below, at, above };

Side mirrored(Side side) {
    return side == Side::below ? Side::above : side == Side::above ? Side::below : Side::at;
}

class Cutter {
  public:
    Cutter(const Bounds& box, const WorkingProgram& program, std::span<const float> constants,
           const Enclosure* registers, std::span<const std::uint32_t> slot, float rounding, Arena& scratch)
        : program_(program),
          constants_(constants),
          registers_(registers),
          slot_(slot),
          middle_(box.centre()),
          margin_(cut_margin(box, rounding)),
          planes_(scratch.take<Plane>(program.code.size())) {
        const glm::dvec3 half = 0.5 * glm::dvec3(box.extent());
        half_ = {half.x, half.y, half.z};
        std::ranges::fill(planes_, Plane{});
    }

    /// Where v may be on that side of τ. For `at` the box may be cut already to where v may be below τ, or above:
    /// `cut`.
    LaneBox where(std::uint32_t v, Side side, float tau, const LaneBox& box, Side cut = Side::at) {
        const Range& r = registers_[slot_[v]].value;
        const bool is_above = static_cast<float>(r.low) > tau + margin_;
        const bool is_below = static_cast<float>(r.high) < tau - margin_;
        if (box.empty() || (is_above && side != Side::above) || (is_below && side != Side::below)) return {};
        if (is_above || is_below || steps_ >= most_steps) return box;
        ++steps_;
        const Instruction& in = program_.code[v];
        if (const auto now = Threshold::of_operand(in, constants_, static_cast<double>(tau))) {
            const auto of = [&](Side s) { return now->is_mirrored ? mirrored(s) : s; };
            return where(in.a, of(side), static_cast<float>(now->tau), box, of(cut));
        }
        switch (in.op) {
            case Op::far_bound:
            case Op::far_bound_inside:
                if (side == Side::at && tau == 0) return where(in.a, Side::at, 0, box);
                return of_both(in, in.op == Op::far_bound ? Side::below : Side::above, side, tau, box, cut);
            case Op::maximum:
                return of_both(in, Side::below, side, tau, box, cut);
            case Op::minimum:
                return of_both(in, Side::above, side, tau, box, cut);
            case Op::corner:
                // Up to 0 it is the maximum; above, no less than each.
                if (tau <= 0) return of_both(in, Side::below, side, tau, box, cut);
                return by_plane(v, side, tau, side == Side::above ? box : both(in, Side::below, tau, box));
            case Op::smooth_minimum:
                // No more than each.
                return by_plane(v, side, tau, side == Side::below ? box : both(in, Side::above, tau, box));
            case Op::absolute:
                if (side == Side::below) return where(in.a, Side::above, -tau, where(in.a, Side::below, tau, box));
                return unite(where(in.a, side, tau, box), where(in.a, mirrored(side), -tau, box));
            default:
                return by_plane(v, side == Side::at ? mirrored(cut) : side, tau, box);
        }
    }

  private:
    struct Plane {
        bool is_found = false;
        PlaneCut cut{};
    };

    LaneBox both(const Instruction& in, Side side, float tau, const LaneBox& box) {
        return where(in.b, side, tau, where(in.a, side, tau, box));
    }
    /// Of a value that is on one side where both operands are, below if it is their maximum; so it is at τ where one
    /// operand is, of what is left of the box on that side.
    LaneBox of_both(const Instruction& in, Side of_all, Side side, float tau, const LaneBox& box, Side cut) {
        if (side == of_all) return both(in, side, tau, box);
        if (side != Side::at) return unite(where(in.a, side, tau, box), where(in.b, side, tau, box));
        const LaneBox left = cut == of_all ? box : both(in, of_all, tau, box);
        if (left.empty()) return {};
        return unite(where(in.a, side, tau, left, of_all), where(in.b, side, tau, left, of_all));
    }
    LaneBox by_plane(std::uint32_t v, Side side, float tau, const LaneBox& box) {
        Plane& plane = planes_[v];
        if (!plane.is_found) plane = {true, {NearlyLinear(registers_[slot_[v]], half_), middle_, margin_}};
        return side == Side::below   ? plane.cut.below(tau, box)
               : side == Side::above ? plane.cut.above(tau, box)
                                     : plane.cut.at(tau, box);
    }

    /// Beyond them a box is left as it is: values that many others share are asked again each time.
    static constexpr int most_steps = 200;

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Enclosure* registers_;
    std::span<const std::uint32_t> slot_;
    glm::vec3 middle_;
    Enclosure::Vector half_{};
    float margin_;
    std::span<Plane> planes_;  ///< of a value, once it was wanted
    int steps_ = 0;
};

}  // namespace

float cut_margin(const Bounds& box, float rounding) {
    const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
    return 3 * rounding + 2e-6f * std::max({farthest.x, farthest.y, farthest.z});
}

Bounds cut_to_zero(std::uint32_t value, const Bounds& box, const Bounds& all, const WorkingProgram& program,
                   std::span<const float> constants, const Enclosure* registers, std::span<const std::uint32_t> slot,
                   float rounding, Arena& scratch) {
    const ArenaScope scope(scratch);
    return Cutter(all, program, constants, registers, slot, rounding, scratch)
        .where(value, Side::at, 0, LaneBox(box))
        .bounds();
}

}  // namespace phasetree::bounding
