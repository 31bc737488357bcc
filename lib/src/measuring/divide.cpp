#include "measuring/divide.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "bounding/enclose.hpp"
#include "bounding/nearly_linear.hpp"
#include "building/values_at_points.hpp"
#include "pruning/jumps.hpp"

namespace phasetree::measuring {

using bounding::EnclosedProgram, bounding::Encloser, bounding::NearlyLinear, bounding::ValueRanges;
using building::values_at_points;
using evaluation::ValuesAtPoint;
using pruning::may_jump, pruning::prune, pruning::RangesInBall, pruning::slopes_in_ball, pruning::without_far_bounds;
using rewriting::ArenaScope, rewriting::ProgramOutput;

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

// Boxes smaller than this many resolutions say little more than rounding errors.
constexpr float least_size = 8;

// Whether a box is large enough to be divided, and can be halved along all three axes (even those along which SubBoxes
// would not halve it).
bool has_room(const Bounds& box, float resolution) {
    const glm::vec3 centre = box.centre();
    for (int i = 0; i < 3; ++i)
        if (!(box.low[i] < centre[i] && centre[i] < box.high[i])) return false;
    return box.diagonal() > least_size * resolution;
}

double signed_value(const ValuesAtPoint& values, const ProgramOutput& o) {
    const auto v = static_cast<double>(values[o.value]);
    return o.negate ? -v : v;
}

// Examines one box: see ExaminedBox.
class Examination {
  public:
    Examination(const Node& node, const MeasureContext& context, Worker& worker)
        : context_(context), worker_(worker), result_{node} {
        result_.can_be_divided = has_room(node.box, context.resolution);
    }

    // False if the box is in one phase. Enclosing and pruning alternate as long as pruning deletes something, because
    // the enclosures of what is left are tighter.
    bool run() {
        const ArenaScope scratch(worker_.scratch);
        Node& node = result_.node;
        Encloser encloser(context_.program, node.box, node.specialisations, node.required, worker_.scratch);
        node.specialisations = {};
        constexpr int most_rounds = 3;
        bool is_enclosed = false;
        for (int round = 0;; ++round) {
            const std::optional<ValueRanges> ranges = encloser.value_ranges(node.program);
            is_enclosed = ranges.has_value();
            if (!ranges) break;
            const auto pruned = prune(node.program, *ranges, context_.program, worker_.arenas());
            if (!pruned) return false;
            const bool is_all_left = pruned->code.size() == node.program.code.size() &&
                                     pruned->outputs.size() == node.program.outputs.size();
            if (is_all_left || round == most_rounds) break;
            node.program = *pruned;
        }
        WorkingProgram program = node.program;
        if (is_enclosed) {
            node.specialisations = kept(encloser.specialisations());
            specialisations_ = node.specialisations;
            // Far bounds (Op::far_bound) do not change the sign of a component, but may make it less linear. Try
            // without them.
            if (const auto near = nearby(program)) {
                const std::optional<ValueRanges> ranges = encloser.value_ranges(*near);
                if (ranges && !prune(*near, *ranges, context_.program, worker_.arenas())) return false;
                is_enclosed = ranges.has_value();
                if (ranges) {
                    program = *near;
                    specialisations_ = encloser.specialisations();
                }
            }
        }
        find_phases(program, is_enclosed ? &encloser.enclosed() : nullptr);
        return true;
    }
    // Treats all phases of the program as possible.
    void leave_open() {
        const ArenaScope scratch(worker_.scratch);
        result_.node.specialisations = {};
        find_phases(result_.node.program, nullptr);
    }
    ExaminedBox result() const { return result_; }

  private:
    std::optional<WorkingProgram> nearby(const WorkingProgram& program) {
        if (!context_.program.has_far_bounds) return std::nullopt;
        return without_far_bounds(program, context_.program, worker_.arenas());
    }
    std::span<const Specialisation> kept(std::span<const Specialisation> found) {
        const std::span<Specialisation> copies = worker_.programs.copy(found);
        for (Specialisation& s : copies) s.data = worker_.programs.copy(s.data);
        return copies;
    }

    void find_phases(const WorkingProgram& program, const EnclosedProgram* enclosed) {
        const std::size_t count = program.outputs.size();
        const MeasuredBox box(result_.node.box, context_.origin);
        result_.phases = worker_.programs.allocate<PhaseInBox>(count);
        bool is_by_rounding = true;  // whether all slack is below the margin, so that smaller boxes would not help
        // The margin covers the rounding errors of a component in 32 bits, and those of its linear function.
        const double margin = 2 * static_cast<double>(context_.program.value_error);
        for (std::size_t k = 0; k < count; ++k) {
            PhaseInBox& p = *std::construct_at(&result_.phases[k]);
            p.phase = program.outputs[k].phase;
            const double slack = enclosed ? set_component(p, program.outputs[k], *enclosed) : unknown;
            p.slack = slack + margin;
            is_by_rounding = is_by_rounding && slack < margin;
            if (!(p.slack < unknown)) {
                p.possible = PartOfBox(box);
                continue;
            }
            p.certain = part_below(p.component.plus(p.slack), box);
            p.possible = part_below(p.component.plus(-p.slack), box);
        }
        if (is_by_rounding) result_.can_be_divided = false;
        sample(program);
    }
    // Sets the linear function near a component, and returns the slack.
    double set_component(PhaseInBox& p, const ProgramOutput& o, const EnclosedProgram& enclosed) const {
        const enclosure::Enclosure found = enclosed.of_output(o);
        const NearlyLinear linear(found, enclosed.half);
        if (!(linear.slack < 1e30)) return unknown;
        const Bounds& box = enclosed.box;
        const glm::dvec3 from_centre = glm::dvec3(box.low) - glm::dvec3(box.centre());
        const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
        const double sign = o.negate ? -1 : 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const enclosure::Interval& g = found.gradient[i];
            const double least = o.negate ? -g.high : g.low, most = o.negate ? -g.low : g.high;
            if (least >= 0) p.falls = static_cast<std::uint8_t>(p.falls | (1u << (2 * i)));
            if (most <= 0) p.falls = static_cast<std::uint8_t>(p.falls | (2u << (2 * i)));
        }
        p.component.at_low = sign * linear.at_centre;
        for (std::size_t i = 0; i < 3; ++i) {
            const double slope = sign * linear.normal[i];
            p.component.at_low += slope * from_centre[static_cast<int>(i)];
            p.component.change[i] = slope * size[static_cast<int>(i)];
        }
        return std::isfinite(p.component.at_low) ? linear.slack : unknown;
    }
    // Samples the components at the eight points of Gauss–Legendre quadrature, for estimates. The mean over these
    // points is exact for polynomials of degree three.
    void sample(const WorkingProgram& program) {
        const std::span<const ProgramOutput> outputs = program.outputs;
        result_.mean_component = worker_.programs.allocate<double>(outputs.size());
        result_.votes = worker_.programs.allocate<int>(outputs.size());
        std::ranges::fill(result_.mean_component, 0.0);
        std::ranges::fill(result_.votes, 0);
        const std::array<glm::vec3, batch_size> points = sampled_points(result_.node.box);
        ValuesAtPoint values = values_at_points(program, specialisations_, points, worker_);
        for (values.lane = 0; values.lane < batch_size; ++values.lane) {
            std::size_t least = 0;
            for (std::size_t k = 0; k < outputs.size(); ++k) {
                const double v = signed_value(values, outputs[k]);
                result_.mean_component[k] += v / batch_size;
                if (v < signed_value(values, outputs[least])) least = k;
            }
            ++result_.votes[least];
            PhaseInBox& p = result_.phases[least];
            if (const double v = signed_value(values, outputs[least]); v < p.deepest) {
                p.deepest = v;
                p.deepest_at = static_cast<std::uint8_t>(values.lane);
            }
        }
    }

    const MeasureContext& context_;
    Worker& worker_;
    ExaminedBox result_;
    std::span<const Specialisation> specialisations_{};  // of the program that is sampled
};

}  // namespace

bool PhaseInBox::is_possible() const {
    if (!(slack < unknown)) return true;
    double least = component.at_low - slack;
    for (const double d : component.change) least += std::min(d, 0.0);
    return least < 0;
}

std::array<glm::vec3, batch_size> sampled_points(const Bounds& box) {
    const glm::vec3 centre = box.centre(), half = 0.57735f * (0.5f * box.extent());
    std::array<glm::vec3, batch_size> points;
    for (std::size_t i = 0; i < batch_size; ++i) points[i] = centre + Bounds{-half, half}.corner(static_cast<int>(i));
    return points;
}

Division::Division(const Node& parent, const MeasureContext& context, Worker& worker)
    : parent_(parent), context_(context), worker_(worker), boxes_(parent.box), values_{}, has_jumps_(false) {
    std::array<glm::vec3, SubBoxes::most> centres;
    for (std::size_t i = 0; i < boxes_.count; ++i) centres[i] = boxes_.box[i].centre();
    values_ = values_at_points(parent.program, parent.specialisations, std::span(centres).first(boxes_.count), worker);
    has_jumps_ = context.program.has_folds && may_jump(parent.program);
}

// The phase whose component is negative at the centre of a box. Returns nullopt if there is none, or if a component is
// not a number. Then, if pruning finds that the box lies in a single phase, this is ignored, because it is not known
// which phase.
std::optional<Phase> Division::phase_at_centre(std::size_t i) const {
    const ValuesAtPoint centre{values_.registers, values_.slot, i};
    std::optional<Phase> found;
    for (const ProgramOutput& o : parent_.program.outputs) {
        const double v = signed_value(centre, o);
        if (!std::isfinite(v)) return std::nullopt;
        if (v < 0 && found) return std::nullopt;
        if (v < 0) found = o.phase;
    }
    return found;
}

ExaminedBox Division::examine(std::size_t i) const {
    Node node{boxes_.box[i], parent_.program, parent_.specialisations};
    const std::optional<Phase> at_centre = phase_at_centre(i);
    const auto in_one_phase = [&] { return ExaminedBox{node, at_centre, {}, {}, {}, false}; };
    {
        const ArenaScope scratch(worker_.scratch);
        const float radius = 0.5f * node.box.diagonal() * (1 + 1e-5f);
        const ValuesAtPoint centre{values_.registers, values_.slot, i};
        const std::span<const float> slope =
            has_jumps_ ? slopes_in_ball(parent_.program, centre, radius, context_.program, worker_.scratch)
                       : parent_.program.lipschitz;
        const RangesInBall ranges{centre, slope, radius, context_.program.value_error};
        std::span<const RequiredOfLocal> required;
        const auto pruned = prune(parent_.program, ranges, context_.program, worker_.arenas(), required);
        if (!pruned && at_centre) return in_one_phase();
        if (pruned) {
            node.program = *pruned;
            node.required = required;
        }
    }
    Examination examination(node, context_, worker_);
    if (examination.run()) return examination.result();
    if (at_centre) return in_one_phase();
    examination.leave_open();
    return examination.result();
}

}  // namespace phasetree::measuring
