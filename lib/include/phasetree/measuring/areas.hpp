// Areas of the interfaces of an object, estimated from the crossings of random lines.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree {

/// An estimate, and its standard error: in two of three cases the true area is within one standard error of the
/// estimate, in 19 of 20 within two. Unlike the intervals of Measured, this is not guaranteed.
struct EstimatedArea {
    double area = 0;  ///< in squared units of length
    double standard_error = 0;
};

struct AreaOptions {
    /// Lines are traced until the standard error of each phase's area is at most this fraction of the area. Positive.
    double tolerance = 2e-3;
    double seconds = std::numeric_limits<double>::infinity();  ///< end after about this time
    std::size_t max_lines = std::size_t{1} << 22;  ///< end after at most this many lines, or 2048 if that is more
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to stop and get what is known so far
};

struct AreaResult {
    struct OfPhase : EstimatedArea {
        Phase phase;
    };
    struct OfContact : EstimatedArea {
        Phase first, second;  ///< in ascending order
    };
    std::vector<OfPhase> phases;      ///< one per phase but the vacuum, ordered by phase: the area of its whole surface
    std::vector<OfContact> contacts;  ///< the interfaces that lines have met, ordered by their phases
    std::size_t lines = 0;
    bool is_within_tolerance = false;  ///< also false if no line has met an interface
};

/// Estimate the areas of all interfaces within the bounds, which must contain everything that is not vacuum.
///
/// By Cauchy and Crofton, random lines through a ball of radius R meet a surface of area A in the ball in A/(2πR²)
/// points on average. Lines come from a low-discrepancy sequence, in 32 copies that are shifted at random; the standard
/// error follows from how much the copies differ. An interface smaller than the distance between lines may be missed by
/// all of them. Neither the area nor the standard error then shows it.
///
/// Uses all threads of TBB's arena. The result is the same for any number of threads, unless time ends it or it is
/// cancelled. Throws ModelError if the bounds are empty or infinite, or if the tolerance or the time is not positive.
AreaResult estimate_areas(const Bounds& bounds, const LineTracer& lines, const AreaOptions& options = {});

}  // namespace phasetree
