#include "phasetree/measuring/slice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measuring/slice_outlines.hpp"

namespace phasetree {

double Slice::area(Phase phase) const {
    double twice = 0;
    for (const Loop& loop : loops) {
        if (loop.phase != phase) continue;
        // Relative to a vertex, because far from the origin products are inaccurate.
        const glm::dvec2 origin = vertices[loop.vertices.front()];
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
            const glm::dvec2 a = glm::dvec2(vertices[loop.vertices[i]]) - origin;
            const glm::dvec2 b = glm::dvec2(vertices[loop.vertices[(i + 1) % loop.vertices.size()]]) - origin;
            twice += a.x * b.y - a.y * b.x;
        }
    }
    return 0.5 * twice;
}

Slice slice(const Phased& object, const SlicePlane& plane, const SliceOptions& options) {
    if (plane.axis < 0 || plane.axis > 2) throw ModelError(fmt::format("a slice has no axis {}", plane.axis));
    if (!std::isfinite(plane.at)) throw ModelError("the position of a slice must be a finite number");
    if (!(options.tolerance >= 0 && std::isfinite(options.tolerance)))
        throw ModelError(fmt::format("the tolerance must be a positive length, or 0, but is {}", options.tolerance));
    const TraceableObject traceable = prepare_to_trace(object);
    const glm::vec3 size = traceable.bounds.extent();
    Slice result;
    result.plane = plane;
    result.tolerance =
        options.tolerance > 0 ? options.tolerance : 1e-3 * static_cast<double>(std::max({size.x, size.y, size.z}));
    if (plane.at < traceable.bounds.low[plane.axis] || plane.at > traceable.bounds.high[plane.axis]) return result;
    const measuring::SliceGrid grid(traceable, plane, result.tolerance);
    const Evaluator evaluator(record(object));
    measuring::set_outlines(result, grid, evaluator, measuring::squares_in_doubt(object, grid, options), options);
    return result;
}

}  // namespace phasetree
