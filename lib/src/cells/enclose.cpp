#include "cells/enclose.hpp"

#include <cmath>

#include "cells/steps.hpp"
#include "phasetree/math/enclosure.hpp"
#include "program/interpret.hpp"

namespace phasetree {

namespace {

using Half = std::array<double, 3>;

/// Of a long primitive (a network, an image, noise) only its slope is used: at most 1 in its own space.
template <class P>
Enclosure enclose_by_slope(const float* constants, const Vec3<Enclosure>& q, const Half& half) {
    const auto centre = [](const Enclosure& e) { return static_cast<float>(e.centre); };
    const double value =
        static_cast<double>(detail::distance_of<P>(constants, Vec3<float>{centre(q.x), centre(q.y), centre(q.z)}));
    const auto slope = detail::each_axis([&](std::size_t i) {
        const double l =
            std::hypot(q.x.gradient[i].magnitude(), q.y.gradient[i].magnitude(), q.z.gradient[i].magnitude());
        return Range{-l, l};
    });
    return Enclosure(value, Range::all(), slope).tightened(half);
}

/// Where on one axis normal·x + value = 0 may hold, within the slack, if the other axes take what they can.
void tighten(Bounds& box, const glm::vec3& normal, float value, float slack) {
    const glm::vec3 centre = box.centre(), half = 0.5f * box.extent();
    for (int i = 0; i < 3; ++i) {
        if (std::abs(normal[i]) < 1e-3f) continue;
        float others = slack;
        for (int j = 0; j < 3; ++j)
            if (j != i) others += std::abs(normal[j]) * half[j];
        const float at = -value / normal[i], reach = others / std::abs(normal[i]);
        box.low[i] = std::max(box.low[i], centre[i] + at - reach);
        box.high[i] = std::min(box.high[i], centre[i] + at + reach);
    }
}

}  // namespace

std::optional<Enclosed> enclose(const WorkingProgram& program, std::span<const float> constants, const Bounds& box,
                                float rounding, Arena& scratch) {
    const std::size_t size = program.code.size();
    if (size > longest_enclosed) return std::nullopt;
    // A fold of space may jump, and then it has no gradient.
    for (const Instruction& in : program.code)
        if (is_fold(in.op)) return std::nullopt;

    const Steps steps = keep_all(program, scratch);
    const std::span<Enclosure> registers = scratch.take<Enclosure>(steps.slots);
    const glm::vec3 middle = box.centre(), extent = box.extent();
    Half half;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        half[k] = 0.5 * static_cast<double>(extent[i]) * (1 + 1e-6);
        registers[k] = Enclosure::coordinate(i, static_cast<double>(middle[i]), half[k]);
    }
    interpret(
        steps.routine(constants.data()), registers.data(),
        [&]<class P>(const float* c, const Vec3<Enclosure>& q) { return enclose_by_slope<P>(c, q, half); },
        [&](Enclosure& e) { e = e.tightened(half); });

    Enclosed result;
    result.box = box;
    const double margin = static_cast<double>(rounding);
    const std::span<float> low = scratch.take<float>(size), high = scratch.take<float>(size);
    for (std::size_t i = 0; i < size; ++i) {
        const Range& v = registers[steps.slot[i]].value;
        if (!(v.low <= v.high)) return std::nullopt;  // not a number somewhere
        low[i] = static_cast<float>(std::max(v.low - margin, -1e30));
        high[i] = static_cast<float>(std::min(v.high + margin, 1e30));
    }
    result.ranges = {low, high, program.lipschitz};

    // Components are 1-Lipschitz, whatever their instructions are.
    const auto component = [&](std::size_t i) {
        Enclosure e = registers[steps.slot[program.outputs[i].value]];
        for (Range& g : e.gradient) g = {std::max(g.low, -1.0), std::min(g.high, 1.0)};
        return e.tightened(half) * (program.outputs[i].negate ? -1.f : 1.f);
    };
    std::size_t possible = 0;
    for (std::size_t i = 0; i < program.outputs.size(); ++i) {
        const Enclosure c = component(i);
        if (c.value.high < -margin) result.is_free = true;
        possible += c.value.low <= margin;
    }
    if (possible < 2) result.is_free = true;
    if (result.is_free || program.outputs.size() != 2 || program.outputs[0].value != program.outputs[1].value)
        return result;

    const Enclosure f = component(0) * (program.outputs[0].negate ? -1.f : 1.f);
    double slack = 0, spread = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Range& g = f.gradient[i];
        if (!(g.low <= g.high)) return result;
        const double width = 0.5 * (g.high - g.low);
        result.bound.normal[static_cast<int>(i)] = static_cast<float>(g.middle());
        slack += width * half[i];
        spread += width * width;
    }
    const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
    const float size_of_numbers = std::max({farthest.x, farthest.y, farthest.z});
    result.bound.offset = static_cast<float>(f.centre - glm::dot(glm::dvec3(result.bound.normal), glm::dvec3(middle)));
    // What the linear part's own floats lose.
    result.bound.slack = static_cast<float>(slack) * (1 + 1e-6f) + 2 * rounding + 1e-6f * size_of_numbers;
    result.bound.spread =
        static_cast<float>(std::sqrt(spread)) * (1 + 1e-3f) + 1e-5f;  // directions are that near unit length
    tighten(result.box, result.bound.normal, static_cast<float>(f.centre), result.bound.slack);
    return result;
}

}  // namespace phasetree
