#include "phasetree/evaluation/precise_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluation/in_blocks.hpp"
#include "evaluation/interpret.hpp"
#include "evaluation/precise_program.hpp"
#include "evaluation/target.hpp"
#include "kernel/precise_kernel.hpp"
#include "math/precise.hpp"
#include "phasetree/math/float_mode.hpp"
#include "program/op_traits.hpp"

namespace phasetree {

using evaluation::CarriedSample, evaluation::in_blocks, evaluation::interpret, evaluation::PreciseProgram,
    evaluation::RoutineSteps;
using kernel::OutputSlot, kernel::Routine;

namespace {

// Points per block of a batch.
constexpr std::size_t precise_block = 1024;
constexpr double farthest_coordinate = 1e100;

bool is_usable(const glm::dvec3& p) {
    return std::abs(p.x) <= farthest_coordinate && std::abs(p.y) <= farthest_coordinate &&
           std::abs(p.z) <= farthest_coordinate;
}

// Runs a program at a point. Returns the registers of the calling thread, which hold its outputs. Appends the numbers
// that the steps compute to `values`, if given.
template <std::size_t n>
const Precise<n>* run(const PreciseProgram& program, const glm::dvec3& p, std::vector<double>* values = nullptr) {
    thread_local std::vector<Precise<n>> registers;
    if (registers.size() < program.assembly.slots) registers.resize(program.assembly.slots);
    for (std::size_t axis = 0; axis < 3; ++axis)
        registers[axis] = Precise<n>::coordinate(axis, p[static_cast<int>(axis)]);
    const Routine routine = program.routine();
    interpret(
        RoutineSteps(routine), registers.data(),
        [&]<class P>(std::size_t, const float* constants, const Vec3<Precise<n>>& q, Precise<n>& to) {
            to = program::distance_of<P>(constants, q);
            if (values) values->push_back(to.value());
        },
        [&](const Precise<n>& v) {
            if (values) values->push_back(v.value());
        });
    return registers.data();
}

const OutputSlot* output_of(const PreciseProgram& program, Phase phase) {
    for (const OutputSlot& o : program.assembly.outputs)
        if (o.phase == static_cast<float>(phase.index)) return &o;
    return nullptr;
}

// The largest number of instructions on a path from the input to an output whose constants can change slopes.
std::size_t depth_of(const Program& program) {
    std::vector<std::size_t> depth(program.instructions.size(), 0);
    std::size_t deepest = 0;
    for (std::size_t i = 1; i < depth.size(); ++i) {
        const Instruction& in = program.instructions[i];
        const int n = program::operands(in.op);
        if (n > 0) depth[i] = depth[in.a];
        if (n > 1) depth[i] = std::max(depth[i], depth[in.b]);
        switch (in.op) {
            case Op::negate:
            case Op::minimum:
            case Op::maximum:
            case Op::far_bound:
            case Op::far_bound_inside:
            case Op::absolute:
            case Op::add_constant:
            case Op::constant_minus:
            case Op::guarded:
                break;
            default:
                ++depth[i];
        }
        deepest = std::max(deepest, depth[i]);
    }
    return deepest;
}

}  // namespace

PreciseEvaluator::PreciseEvaluator(const Phased& object) {
    auto made = std::make_shared<PreciseProgram>();
    made->program = record(object);
    made->assembly = evaluation::assemble(made->program.instructions, program::outputs_of(made->program));
    const std::size_t before = searches_in_floats();
    run<0>(*made, glm::dvec3(0));  // runs every instruction, whatever the point
    made->searches_in_floats = searches_in_floats() != before;
    made->runs_in_batches = !made->searches_in_floats && kernel::can_run_precisely(made->routine());
    // A factor or unit vector in floats is off by less than 2.5·10⁻⁷ of it. Slopes multiply along a path.
    made->lipschitz_excess = 2.5e-7 * static_cast<double>(2 + depth_of(made->program));
    program_ = std::move(made);
}

namespace {

// Finds the label and the distances from the components; value(output) returns a component.
template <class Value>
CarriedSample classified(const PreciseProgram& program, Phase carried, Value&& value) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CarriedSample result{{vacuum, infinity, infinity}, infinity};
    for (const OutputSlot& o : program.assembly.outputs) {
        const double v = value(o) * static_cast<double>(o.sign);
        if (o.phase == static_cast<float>(carried.index)) result.component = v;
        if (v < result.own) {
            result.interface_distance = result.own;
            result.own = v;
            result.phase = Phase{static_cast<std::uint8_t>(o.phase)};
        } else if (v < result.interface_distance) {
            result.interface_distance = v;
        }
    }
    return result;
}

}  // namespace

CarriedSample evaluation::sample_for(const PreciseProgram& program, const glm::dvec3& p, Phase carried) {
    const Precise<0>* registers = run<0>(program, p);
    return classified(program, carried, [&](const OutputSlot& o) { return registers[o.slot].value(); });
}

void evaluation::answer(const PreciseProgram& program, std::span<SampleQuery> queries) {
    if (queries.empty()) return;
    if (!program.runs_in_batches) {
        for (SampleQuery& q : queries) q.result = sample_for(program, q.point, q.carried);
        return;
    }
    // A batch costs less than a single point with the scalar interpreter, so it pays off for one point, too.
    struct alignas(64) Lanes {
        double lane[batch_size];
    };
    thread_local std::vector<Lanes> registers;
    if (registers.size() < program.assembly.slots) registers.resize(program.assembly.slots);
    for (std::size_t k = 0; k < batch_size; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
            registers[axis].lane[k] = queries[std::min(k, queries.size() - 1)].point[static_cast<int>(axis)];
    kernel::run_precisely_for(active_kernel())(program.routine(), registers.front().lane);
    for (std::size_t k = 0; k < queries.size(); ++k)
        queries[k].result =
            classified(program, queries[k].carried, [&](const OutputSlot& o) { return registers[o.slot].lane[k]; });
}

std::vector<double> evaluation::values_at(const PreciseProgram& program, const glm::dvec3& p) {
    std::vector<double> values;
    run<0>(program, p, &values);
    return values;
}

PreciseSample PreciseEvaluator::sample(const glm::dvec3& p) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (!is_usable(p)) return {vacuum, nan, nan};
    const FlushSubnormals flush;
    return evaluation::sample_for(*program_, p, vacuum);
}

double PreciseEvaluator::safe_distance(const glm::dvec3& p, double error) const {
    const double s = sample(p).interface_distance;
    if (!(s < std::numeric_limits<double>::infinity())) return s;
    const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z), s});
    return std::max(s * (1 - lipschitz_excess()) - std::max(value_error(farthest), error), 0.0);
}

double PreciseEvaluator::component(const glm::dvec3& p, Phase phase) const {
    if (!is_usable(p)) return std::numeric_limits<double>::quiet_NaN();
    const OutputSlot* output = output_of(*program_, phase);
    if (!output) return std::numeric_limits<double>::infinity();
    const FlushSubnormals flush;
    return run<0>(*program_, p)[output->slot].value() * static_cast<double>(output->sign);
}

glm::dvec3 PreciseEvaluator::gradient(const glm::dvec3& p, Phase phase) const {
    if (!is_usable(p)) return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    const OutputSlot* output = output_of(*program_, phase);
    if (!output) return glm::dvec3(0);
    const FlushSubnormals flush;
    const auto& slopes = run<3>(*program_, p)[output->slot].slopes();
    return glm::dvec3(slopes[0], slopes[1], slopes[2]) * static_cast<double>(output->sign);
}

bool PreciseEvaluator::locate(std::span<const glm::dvec3> points, std::span<Phase> phases,
                              const std::function<bool()>& cancelled) const {
    if (phases.size() != points.size()) throw std::invalid_argument("there must be as many phases as points");
    return in_blocks(points.size(), precise_block, cancelled, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) phases[i] = label(points[i]);
    });
}

bool PreciseEvaluator::safe_distances(std::span<const glm::dvec3> points, std::span<double> distances, double error,
                                      const std::function<bool()>& cancelled) const {
    if (distances.size() != points.size()) throw std::invalid_argument("there must be as many distances as points");
    return in_blocks(points.size(), precise_block, cancelled, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) distances[i] = safe_distance(points[i], error);
    });
}

double PreciseEvaluator::value_error(double farthest) const {
    return farthest * (program_->searches_in_floats ? 0x1p-22 : 0x1p-44);
}

double PreciseEvaluator::lipschitz_excess() const {
    return program_->lipschitz_excess;
}

}  // namespace phasetree
