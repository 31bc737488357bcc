#include "cells/data.hpp"

#include <algorithm>

#include "phasetree/trace/tracer.hpp"

namespace phasetree {

using cells::CurvatureCode;
using kernel::few_slots, kernel::Routine, kernel::Visit;

namespace {

// The limit of memory. There are 2³² indices, which is enough for the cells in 64 gigabytes.
std::size_t limit_bytes(const CellOptions& options) {
    constexpr std::size_t largest = std::size_t{64} << 30;
    return std::min(options.most_bytes > 0 ? options.most_bytes : default_cell_bytes(), largest);
}

}  // namespace

InterfaceCells::Data::Data(const Phased& object, const CellOptions& options) {
    const TraceableObject traceable = prepare_to_trace(object, options.resolution);
    bounds = traceable.bounds;
    resolution = traceable.resolution;
    warning = traceable.warning;
    reach = 4 * resolution;
    opaque = options.opaque;
    deepest = options.deepest;
    quality = options.quality;
    most_bytes = limit_bytes(options);
    curvature_code = CurvatureCode(bounds.diagonal());
}

bool InterfaceCells::Data::needs_certificate(const Cell& c, const Routine& r,
                                             const std::optional<Phase>& carried) const {
    const bool is_known = c.curvature != CurvatureCode::unknown,
               is_other_known = c.other_curvature != CurvatureCode::unknown;
    if (!carried || r.output_count > 2) return !is_known || !is_other_known;
    return !(carried->index == c.first_phase ? is_known : is_other_known);
}

std::optional<Crossing> InterfaceCells::Data::first_crossing(std::size_t cell, const Search& search,
                                                             TraceCounters& counters) const {
    ++counters.visits;
    const Cell& c = cells[cell];
    // The next cell that a ray meets is often a neighbour in this list, too.
    __builtin_prefetch(cells.data() + cell + 1);
    __builtin_prefetch(cells.data() + (cell > 0 ? cell - 1 : 0));
    Routine r = routine(c);
    // These are not needed before the ray is clipped, and are on their way from memory until then.
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

}  // namespace phasetree
