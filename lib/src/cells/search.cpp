// The search for a change of phase along a ray within one cell. It runs for every cell that a ray meets, so this file's
// helpers are inlined into one function.
#include "cells/data.hpp"
#include "evaluation/target.hpp"
#include "trace/march.hpp"

namespace phasetree {

using cells::CurvatureCode;
using evaluation::active_kernel;
using kernel::FaceBatch, kernel::few_slots, kernel::Routine, kernel::Visit;
using trace::FaceAnswer;

inline bool InterfaceCells::Data::needs_certificate(const Cell& c, const Routine& r,
                                                    const std::optional<Phase>& carried) const {
    const bool is_known = c.curvature != CurvatureCode::unknown,
               is_other_known = c.other_curvature != CurvatureCode::unknown;
    if (!carried || r.output_count > 2) return !is_known || !is_other_known;
    return !(carried->index == c.first_phase ? is_known : is_other_known);
}

inline bool InterfaceCells::Data::starts_in_phase(const Cell& c, const Search& search, TraceCounters& counters) const {
    ++counters.batches;
    const Routine r = routine(c);
    const BatchOfFloats t{{search.t_min, search.t_min, search.t_min, search.t_min, search.t_min, search.t_min,
                           search.t_min, search.t_min}};
    Samples samples;
    Evaluator::Workspace& w = search.workspace ? *search.workspace : Evaluator::thread_workspace();
    active_kernel().sample_ray(r, &search.ray.origin.x, &search.ray.direction.x, t.lane.data(), w.registers(slots(c)),
                               samples.label.lane.data(), samples.distance.lane.data());
    return samples.label[0] == trace::carried_by(search.carried);
}

inline std::optional<Crossing> InterfaceCells::Data::first_crossing(std::size_t cell, const Search& search,
                                                                    TraceCounters& counters) const {
    ++counters.visits;
    const Cell& c = cells[cell];
    // The next cell that the ray meets is often a neighbour in this list.
    __builtin_prefetch(cells.data() + cell + 1);
    __builtin_prefetch(cells.data() + (cell > 0 ? cell - 1 : 0));
    Routine r = routine(c);
    if (const std::span<const FaceBatch> faces = faces_of(cell); !faces.empty()) {
        Crossing crossing;
        const FaceAnswer answer = trace::first_crossing(
            faces_of_cell(c, faces), {search.ray, search.t_min, search.t_max, resolution, search.carried}, crossing);
        if (answer == FaceAnswer::crossing) return crossing;
        if (answer == FaceAnswer::none) return std::nullopt;
        if (answer == FaceAnswer::none_if_in_phase && starts_in_phase(c, search, counters)) return std::nullopt;
    }
    // Prefetch these here, so that they arrive while the ray is being clipped.
    __builtin_prefetch(r.data);
    __builtin_prefetch(r.data + r.count);
    if (needs_certificate(c, r, search.carried)) {
        r.certificate = certificates.data() + first_certificate[cell];
        r.certificate_steps = first_certificate[cell + 1] - first_certificate[cell];
        __builtin_prefetch(r.certificate);
    }
    const auto many_registers = [&] {
        return (search.workspace ? *search.workspace : Evaluator::thread_workspace()).registers(slots(c));
    };
    return trace::first_crossing(
        {.box = &c.box,
         .bound = &c.bound,
         .routine = &r,
         .ray = &search.ray,
         .registers = slots(c) <= few_slots ? nullptr : many_registers(),
         .curvature = {curvature_code.decode(c.curvature), curvature_code.decode(c.other_curvature)},
         .t_min = search.t_min,
         .t_max = search.t_max,
         .resolution = resolution,
         .carried = trace::carried_by(search.carried),
         .rise = search.leaving_hint ? search.leaving_hint->rise : Visit::no_leaving_hint},
        counters);
}

std::optional<Crossing> InterfaceCells::first_crossing(std::size_t cell, const glm::vec3& origin,
                                                       const glm::vec3& direction, float t_min, float t_max,
                                                       std::optional<Phase> carried, Evaluator::Workspace& w,
                                                       TraceCounters& counters) const {
    return data_->first_crossing(cell, {TracedRay(origin, direction), t_min, t_max, carried, {}, &w}, counters);
}

std::optional<Crossing> InterfaceCells::first_crossing(std::size_t cell, const TracedRay& ray, float t_min, float t_max,
                                                       std::optional<Phase> carried,
                                                       const std::optional<LeavingHint>& leaving_hint,
                                                       TraceCounters& counters) const {
    return data_->first_crossing(cell, {ray, t_min, t_max, carried, leaving_hint, nullptr}, counters);
}

}  // namespace phasetree
