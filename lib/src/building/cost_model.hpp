#pragma once

#include <algorithm>

#include "kernel/linear_bound.hpp"
#include "phasetree/nodes/fields/siren.hpp"
#include "rewriting/live_set.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::building {

using kernel::Curvature, kernel::LinearBound;
using program::OpTraits, program::ProgramOutput, program::traits;
using rewriting::Arena, rewriting::ArenaScope, rewriting::LiveSet, rewriting::LocalValue, rewriting::WorkingProgram;

/// What rays spend in a cell, in nanoseconds for each unit of surface (which is how many come, up to a factor). Rough:
/// only what is dearer than what matters.
namespace cost_model {
inline constexpr float parts = 12;  ///< of Embree's going down to the parts of a box
inline constexpr float visit = 60;  ///< of entering a cell
/// Rays that start at an interface, for each unit of its area. (Those that enter come through both sides of a box.)
inline constexpr float starts = 0.5f;
inline constexpr float batch = 25, step = 2.4f;  ///< of a batch, and of each of its instructions
inline constexpr float certain = 1.8f;           ///< batches where the field is linear,
inline constexpr float unknown = 0.7f;           ///< more of them the less it lets rays pass without one,
inline constexpr float uneven = 3;               ///< the more its gradient varies,
inline constexpr float proven = 0.5f;            ///< and where only a certificate tells how it bends,
inline constexpr float blind = 2;                ///< or nothing
}  // namespace cost_model

/// How much work an instruction is, in halves of a simple one.
inline unsigned half_works(const Instruction& in, std::span<const float> constants) {
    const OpTraits& t = traits(in.op);
    return t.is_network ? static_cast<unsigned>(Siren::Network::multiplications(&constants[in.data])) / 3
                        : t.half_works;
}
/// How much work a program is, in simple instructions; and its first component alone, if more than two phases meet.
struct Work {
    float all = 0, first = 0;
};
inline Work work(const WorkingProgram& program, std::span<const float> constants, std::span<const LocalValue> local,
                 Arena& scratch) {
    unsigned halves = 0;
    for (const Instruction& in : program.code.subspan(1)) halves += half_works(in, constants);
    for (const LocalValue& v : local) halves -= v.half_works_saved;
    const float all = 0.5f * static_cast<float>(halves);
    if (program.outputs.size() == 2) return {all, all};
    const ArenaScope scope(scratch);
    const LiveSet first(program, program.outputs.first(1), scratch);
    unsigned rest = 0;
    for (std::size_t i = 1; i < program.code.size(); ++i)
        rest += first.has(i) ? 0u : half_works(program.code[i], constants);
    for (const LocalValue& v : local) rest -= first.has(v.value) ? 0u : v.half_works_saved;
    return {all, all - 0.5f * static_cast<float>(rest)};
}

inline float surface(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// Of an interface across a box, about.
inline float one_interface(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return std::max({e.x * e.y, e.y * e.z, e.z * e.x});
}

/// How many batches a visit takes of rays in one phase: of the first component or of the others.
inline float batches(const Bounds& box, const LinearBound& bound, float curvature_bound, bool has_certificate) {
    float unknown = 3, spread = 1;
    if (bound.slack < Bounds::infinity) {
        const float thickness = 0.5f * glm::dot(glm::abs(bound.normal), box.extent());
        unknown = std::min(1.f, bound.slack / std::max(thickness, 1e-30f));
        spread = std::min(1.f, bound.spread);
    }
    const bool is_blind = !(curvature_bound < Curvature::unknown);
    return cost_model::certain + cost_model::unknown * unknown + cost_model::uneven * spread +
           (!is_blind         ? 0.f
            : has_certificate ? cost_model::proven
                              : cost_model::blind);
}
/// Half of the rays are taken to be in the first phase, if that is the vacuum; all, if the others are opaque. Where
/// more than two phases meet they need its component alone, and the rest where they leave it.
inline float cost(const Bounds& box, const LinearBound& bound, const Curvature& curvature,
                  const WorkingProgram& program, const Work& work, bool has_certificate, PhaseSet opaque) {
    const float all = cost_model::batch + cost_model::step * work.all;
    const auto is_opaque = [&](const ProgramOutput& o) { return opaque.contains(o.phase); };
    const bool is_one_clear = std::ranges::all_of(program.outputs.subspan(1), is_opaque);
    const bool has_two = program.outputs.size() == 2;
    const float others =
        batches(box, has_two ? bound : LinearBound{}, curvature.bound[1], has_two && has_certificate) * all;
    float first = batches(box, bound, curvature.bound[0], has_certificate) * all;
    if (!has_two) {
        first = others;
        if (program.outputs[0].phase == vacuum || is_one_clear)
            first = batches(box, bound, curvature.bound[0], has_certificate) *
                        (cost_model::batch + cost_model::step * work.first) +
                    all;
    }
    const float in_first = is_one_clear ? 1.f : is_opaque(program.outputs[0]) ? 0.f : 0.5f;
    return surface(box) * (cost_model::visit + in_first * first + (1 - in_first) * others);
}
/// A cell of this size cannot cost less.
inline float least_cost(const Bounds& box) {
    return surface(box) * (cost_model::visit + cost_model::certain * (cost_model::batch + cost_model::step));
}

}  // namespace phasetree::building
