// The cost of tracing paths, as reported by `phasetree render --stats`.
#pragma once

#include <cstdint>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

struct PathCounters {
    TraceCounters trace;             ///< cost of the rays in the cells of the object
    std::uint64_t rays = 0;          ///< all rays: those of paths, and shadow rays
    std::uint64_t paths = 0;         ///< started at the camera
    std::uint64_t interactions = 0;  ///< scattering events of paths

    PathCounters& operator+=(const PathCounters& other) {
        trace.visits += other.trace.visits;
        trace.batches += other.trace.batches;
        trace.phantoms += other.trace.phantoms;
        rays += other.rays;
        paths += other.paths;
        interactions += other.interactions;
        return *this;
    }
};

}  // namespace phasetree::tracer
