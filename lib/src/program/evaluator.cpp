#include "phasetree/program/evaluator.hpp"

#include <hwy/targets.h>

#include <cstring>
#include <limits>

#include "kernel/kernel.hpp"
#include "phasetree/math/dual.hpp"
#include "phasetree/nodes/list.hpp"
#include "program/target.hpp"

namespace phasetree {

namespace {

constexpr std::uint32_t first_primitive = static_cast<std::uint32_t>(Op::first_primitive);
constexpr std::uint32_t first_map = first_primitive + static_cast<std::uint32_t>(Primitives::size);

bool is_point(Op op) {
    return op == Op::input || static_cast<std::uint32_t>(op) >= first_map;
}

/// Hands out register slots; a freed one is used again.
class Slots {
  public:
    std::uint32_t take(std::uint32_t size) {
        auto& free = size == 1 ? scalars_ : points_;
        if (!free.empty()) {
            const std::uint32_t slot = free.back();
            free.pop_back();
            return slot;
        }
        const std::uint32_t slot = end_;
        end_ += size;
        return slot;
    }
    void give_back(std::uint32_t slot, std::uint32_t size) { (size == 1 ? scalars_ : points_).push_back(slot); }
    std::uint32_t end() const { return end_; }

  private:
    std::vector<std::uint32_t> scalars_, points_;
    std::uint32_t end_ = 0;
};

int operands(Op op) {
    switch (op) {
        case Op::input:
            return 0;
        case Op::add:
        case Op::subtract:
        case Op::minimum:
        case Op::maximum:
        case Op::smooth_minimum:
            return 2;
        default:
            return 1;
    }
}

}  // namespace

Evaluator::Evaluator(Program program) : program_(std::move(program)) {
    const auto& code = program_.instructions;
    const auto forever = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> last_use(code.size(), 0);
    for (std::uint32_t i = 0; i < code.size(); ++i) {
        if (operands(code[i].op) > 0) last_use[code[i].a] = i;
        if (operands(code[i].op) > 1) last_use[code[i].b] = i;
    }
    last_use[0] = forever;  // the input keeps slots 0 … 2
    for (const Output& o : program_.outputs) last_use[o.value] = forever;

    Slots slots;
    std::vector<std::uint32_t> slot(code.size(), 0);
    steps_.reserve(code.size());
    for (std::uint32_t i = 0; i < code.size(); ++i) {
        const Instruction& in = code[i];
        const int n = operands(in.op);
        const std::uint32_t size = is_point(in.op) ? 3 : 1;
        // A map writes its result only after it has read its point, but one component at a time into other slots, so
        // the result is placed before the operands are freed.
        slot[i] = slots.take(size);
        if (in.op != Op::input)
            steps_.push_back(
                {static_cast<std::uint32_t>(in.op), slot[i], n > 0 ? slot[in.a] : 0, n > 1 ? slot[in.b] : 0, in.data});
        if (n > 0 && last_use[in.a] == i) slots.give_back(slot[in.a], is_point(code[in.a].op) ? 3 : 1);
        if (n > 1 && in.b != in.a && last_use[in.b] == i) slots.give_back(slot[in.b], is_point(code[in.b].op) ? 3 : 1);
    }
    slots_ = slots.end();
    for (const Output& o : program_.outputs) {
        output_slot_.push_back(slot[o.value]);
        output_phase_.push_back(static_cast<float>(o.phase.index));
    }
}

namespace {
Routine routine_of(const std::vector<Evaluator::Step>& steps, const Program& program,
                   const std::vector<std::uint32_t>& slot, const std::vector<float>& phase) {
    return {steps.data(), steps.size(), program.constants.data(), slot.data(), phase.data(), slot.size()};
}
}  // namespace

void Evaluator::evaluate(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z,
                         std::span<BatchOfFloats> out, Workspace& w) const {
    active_kernel().evaluate(routine_of(steps_, program_, output_slot_, output_phase_), x.lane.data(), y.lane.data(),
                             z.lane.data(), w.registers(slots_), out.data()->lane.data());
}

void Evaluator::sample(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z, Samples& out,
                       Workspace& w) const {
    active_kernel().sample(routine_of(steps_, program_, output_slot_, output_phase_), x.lane.data(), y.lane.data(),
                           z.lane.data(), w.registers(slots_), out.label.lane.data(), out.distance.lane.data());
}

void Evaluator::sample_ray(const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t, Samples& out,
                           Workspace& w) const {
    active_kernel().sample_ray(routine_of(steps_, program_, output_slot_, output_phase_), &origin.x, &direction.x,
                               t.lane.data(), w.registers(slots_), out.label.lane.data(), out.distance.lane.data());
}

Phases<float> Evaluator::distances(const glm::vec3& p, Workspace& w) const {
    BatchOfFloats x, y, z;
    x.lane.fill(p.x);
    y.lane.fill(p.y);
    z.lane.fill(p.z);
    std::vector<BatchOfFloats> out(program_.outputs.size());
    evaluate(x, y, z, out, w);
    Phases<float> result;
    for (std::size_t i = 0; i < out.size(); ++i) result.set(program_.outputs[i].phase.index, out[i][0]);
    return result;
}

Phase Evaluator::label(const glm::vec3& p, Workspace& w) const {
    return phasetree::label(distances(p, w));
}

namespace {

/// One instruction over dual numbers; values are indexed as in the program.
template <class... Ps, class... Ms>
void run_dual(const Instruction& in, const float* constants, const Vec3<Dual>& point, std::vector<Dual>& scalars,
              std::vector<Vec3<Dual>>& points, std::vector<std::uint32_t>& place, std::uint32_t i, TypeList<Ps...>,
              TypeList<Ms...>) {
    const auto op = static_cast<std::uint32_t>(in.op);
    const auto load = [&](auto& s) { std::memcpy(static_cast<void*>(&s), constants + in.data, sizeof s); };
    if (op < first_map) {
        std::uint32_t k = first_primitive;
        const auto attempt = [&]<class P>() {
            if (k++ != op) return;
            P primitive;
            load(primitive);
            scalars[i] = primitive.distance(point);
        };
        (attempt.template operator()<Ps>(), ...);
    } else {
        std::uint32_t k = first_map;
        const auto attempt = [&]<class M>() {
            if (k++ != op) return;
            M map;
            load(map);
            place[i] = static_cast<std::uint32_t>(points.size());
            points.push_back(map(point));
        };
        (attempt.template operator()<Ms>(), ...);
    }
}

}  // namespace

glm::vec3 Evaluator::gradient(const glm::vec3& p, Phase phase) const {
    const Output* output = nullptr;
    for (const Output& o : program_.outputs)
        if (o.phase == phase) output = &o;
    if (!output) return glm::vec3(0);

    const auto& code = program_.instructions;
    thread_local std::vector<Dual> scalars;
    thread_local std::vector<Vec3<Dual>> points;
    thread_local std::vector<std::uint32_t> place;
    scalars.resize(code.size());
    place.resize(code.size());
    points.clear();
    points.push_back({Dual(p.x, 1, 0, 0), Dual(p.y, 0, 1, 0), Dual(p.z, 0, 0, 1)});
    place[0] = 0;
    for (std::uint32_t i = 1; i <= output->value; ++i) {
        const Instruction& in = code[i];
        const Dual& a = scalars[in.a];
        const Dual& b = scalars[in.b];
        const float* c = program_.constants.data() + in.data;
        switch (in.op) {
            case Op::input:
                break;
            case Op::negate:
                scalars[i] = -a;
                break;
            case Op::add:
                scalars[i] = a + b;
                break;
            case Op::subtract:
                scalars[i] = a - b;
                break;
            case Op::minimum:
                scalars[i] = min(a, b);
                break;
            case Op::maximum:
                scalars[i] = max(a, b);
                break;
            case Op::absolute:
                scalars[i] = abs(a);
                break;
            case Op::add_constant:
                scalars[i] = a + *c;
                break;
            case Op::constant_minus:
                scalars[i] = *c - a;
                break;
            case Op::multiply_constant:
                scalars[i] = a * *c;
                break;
            case Op::smooth_minimum:
                scalars[i] = smooth_min(a, b, *c);
                break;
            default: {
                const Vec3<Dual> point = points[place[in.a]];
                run_dual(in, program_.constants.data(), point, scalars, points, place, i, Primitives(), PointMaps());
            }
        }
    }
    const Dual& g = scalars[output->value];
    return {g.dx, g.dy, g.dz};
}

std::size_t Evaluator::bytes() const {
    return program_.bytes() + steps_.size() * sizeof(Step) +
           output_slot_.size() * (sizeof(std::uint32_t) + sizeof(float)) + sizeof(*this);
}

}  // namespace phasetree
