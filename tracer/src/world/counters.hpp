// What tracing paths cost, as `phasetree render --stats` reports it.
#pragma once

#include <cstdint>

#include "phasetree/cells/cells.hpp"

namespace phasetree::tracer {

struct PathCounters {
    TraceCounters trace;             ///< what the rays cost in the cells of the object
    std::uint64_t rays = 0;          ///< all rays that were traced: those of paths and those that look for light
    std::uint64_t paths = 0;         ///< begun at the camera
    std::uint64_t interactions = 0;  ///< at which a path was scattered

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
