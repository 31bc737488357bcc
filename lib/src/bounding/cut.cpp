#include "bounding/cut.hpp"

#include <array>

#include "bounding/plane_cut.hpp"
#include "rewriting/threshold.hpp"

namespace phasetree::bounding {

using rewriting::ArenaScope, rewriting::Threshold;

namespace {

// The side of a threshold on which a value lies. A value equal to the threshold lies on all three.
enum class Side { below, at, above };

Side reversed(Side side) {
    return side == Side::below ? Side::above : side == Side::above ? Side::below : Side::at;
}

// The set of points on one side of a threshold τ: {v ≤ τ}, {v = τ} or {v ≥ τ}.
struct LevelSet {
    std::uint32_t value;
    Side side;
    float tau;
};

// Finds boxes around level sets by recursion from a value to its operands.
class Cutter {
  public:
    Cutter(const EnclosedProgram& enclosed, Arena& scratch)
        : enclosed_(enclosed),
          middle_(enclosed.box.centre()),
          margin_(cut_margin(enclosed.box, enclosed.context->value_error)),
          planes_(scratch.allocate<Plane>(enclosed.program.code.size())) {
        const glm::dvec3 half = 0.5 * glm::dvec3(enclosed.box.extent());
        half_ = {half.x, half.y, half.z};
        std::ranges::fill(planes_, Plane{});
    }

    // A box around the part of `box` in a level set. For {v = τ}, `already_cut` says whether the box has already been
    // cut to where v ≤ τ (below) or v ≥ τ (above) can hold; `at` means that it has not been cut.
    LaneBox box_around(const LevelSet& set, const LaneBox& box, Side already_cut = Side::at) {
        const auto [v, side, tau] = set;
        const Interval& range = enclosed_[v].value;
        const bool is_above = static_cast<float>(range.low) > tau + margin_;
        const bool is_below = static_cast<float>(range.high) < tau - margin_;
        if (box.empty() || (is_above && side != Side::above) || (is_below && side != Side::below)) return {};
        if (is_above || is_below || steps_ >= most_steps) return box;
        ++steps_;
        const Instruction& in = enclosed_.program.code[v];
        if (const auto operand = Threshold::of_operand(in, enclosed_.constants(), static_cast<double>(tau))) {
            const auto of_operand = [&](Side s) { return operand->is_reversed ? reversed(s) : s; };
            return box_around({in.a, of_operand(side), static_cast<float>(operand->tau)}, box, of_operand(already_cut));
        }
        switch (in.op) {
            case Op::far_bound:
            case Op::far_bound_inside:
                // Its zeros are those of the first operand.
                if (side == Side::at && tau == 0) return box_around({in.a, Side::at, 0}, box);
                return of_extremum(in.op == Op::far_bound ? Side::below : Side::above, set, box, already_cut);
            case Op::maximum:
                return of_extremum(Side::below, set, box, already_cut);
            case Op::minimum:
                return of_extremum(Side::above, set, box, already_cut);
            case Op::corner:
                // Up to 0 it equals the maximum; above 0 it is at least as large as either operand.
                if (tau <= 0) return of_extremum(Side::below, set, box, already_cut);
                return by_plane(set, side == Side::above ? box : of_both(in, Side::below, tau, box));
            case Op::nearer:
                // It is at least as large as the first operand.
                return by_plane(set, side == Side::above ? box : box_around({in.a, Side::below, tau}, box));
            case Op::smooth_minimum:
                // It is at most as large as either operand.
                return by_plane(set, side == Side::below ? box : of_both(in, Side::above, tau, box));
            case Op::absolute:
                if (side == Side::below)
                    return box_around({in.a, Side::above, -tau}, box_around({in.a, Side::below, tau}, box));
                return unite({in.a, reversed(side), -tau}, {in.a, side, tau}, box);
            default:
                // In a box already cut to v ≤ τ, only the part where v ≥ τ remains to be found, and vice versa. If it
                // was not cut, reversed() returns `at` again.
                return by_plane({v, side == Side::at ? reversed(already_cut) : side, tau}, box);
        }
    }

  private:
    struct Plane {
        bool is_found = false;
        PlaneCut cut{};
    };

    // A box around the points of `box` where both operands are on one side of τ.
    LaneBox of_both(const Instruction& in, Side side, float tau, const LaneBox& box) {
        return box_around({in.b, side, tau}, box_around({in.a, side, tau}, box));
    }
    // A box around a level set of a maximum, for which `of_both_side` is `below`. The maximum is on that side of τ
    // where both operands are, and on the other side where either operand is. It equals τ where one operand equals τ
    // and both are on the side `of_both_side`. The same is true of a minimum, with `of_both_side` `above`.
    LaneBox of_extremum(Side of_both_side, const LevelSet& set, const LaneBox& box, Side already_cut) {
        const auto [v, side, tau] = set;
        const Instruction& in = enclosed_.program.code[v];
        if (side == of_both_side) return of_both(in, side, tau, box);
        if (side != Side::at) return unite({in.b, side, tau}, {in.a, side, tau}, box);
        const LaneBox rest = already_cut == of_both_side ? box : of_both(in, of_both_side, tau, box);
        if (rest.empty()) return {};
        return unite({in.b, side, tau}, {in.a, side, tau}, rest, of_both_side);
    }
    // A box around the parts of `box` in either level set. The order matters, because the two share a limit of steps:
    // those that the first one takes are no longer available to the second one. If both were arguments of one call, the
    // order would depend on the compiler.
    LaneBox unite(const LevelSet& first, const LevelSet& second, const LaneBox& box, Side already_cut = Side::at) {
        const LaneBox around_first = box_around(first, box, already_cut);
        return bounding::unite(around_first, box_around(second, box, already_cut));
    }
    // A box around a level set of a value from its linear bound, without considering its operands.
    LaneBox by_plane(const LevelSet& set, const LaneBox& box) {
        Plane& plane = planes_[set.value];
        if (!plane.is_found) plane = {true, {NearlyLinear(enclosed_[set.value], half_), middle_, margin_}};
        return set.side == Side::below   ? plane.cut.below(set.tau, box)
               : set.side == Side::above ? plane.cut.above(set.tau, box)
                                         : plane.cut.at(set.tau, box);
    }

    // The maximum number of steps of the recursion, after which boxes are left as they are. A value that is an operand
    // of many others is visited once for each path to it.
    static constexpr int most_steps = 200;

    const EnclosedProgram& enclosed_;
    glm::vec3 middle_;
    Enclosure::Vector half_{};
    float margin_;
    std::span<Plane> planes_;  // of each value, found on first use
    int steps_ = 0;
};

}  // namespace

float cut_margin(const Bounds& box, float value_error) {
    const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
    return 3 * value_error + 2e-6f * std::max({farthest.x, farthest.y, farthest.z});
}

Bounds cut_to_zero(std::uint32_t value, const Bounds& box, const EnclosedProgram& enclosed, Arena& scratch) {
    const ArenaScope scope(scratch);
    return Cutter(enclosed, scratch).box_around({value, Side::at, 0}, LaneBox(box)).bounds();
}

}  // namespace phasetree::bounding
