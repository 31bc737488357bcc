#pragma once

#include "measuring/phase_sums.hpp"
#include "phasetree/measuring/measure.hpp"

namespace phasetree::measuring {

/// Moments of a body of which each lies between two bounds, rounding errors included.
struct MomentBounds {
    Moments low{}, high{}, estimate{};

    MomentBounds() = default;
    /// Those of a phase, after sums in which no term took part in more than this many additions.
    MomentBounds(const PhaseSums&, std::size_t additions);
    /// Adds the moments of another body, times a factor that is not negative.
    void add(const MomentBounds&, double factor);
};

/// The volume, and whatever follows from the moments of the mass, which are those of the volume times the density at
/// each point. Coordinates of the moments are relative to `origin`.
Body body_of(const Measured& volume, const MomentBounds& mass, const std::array<double, 3>& origin);

/// A number between two bounds, low ≤ high. The estimate is moved into the interval if it lies outside.
Measured measured(double low, double high, double estimate);

}  // namespace phasetree::measuring
