#pragma once

#include "measuring/phase_sums.hpp"
#include "phasetree/measuring/measure.hpp"

namespace phasetree::measuring {

/// Bounds of the moments of a body, rounding errors included, and an estimate of each.
struct MomentBounds {
    Moments low{}, high{}, estimate{};

    MomentBounds() = default;
    /// The moments of a phase, from sums in which each term took part in at most `additions` additions.
    MomentBounds(const PhaseSums&, std::size_t additions);
    /// Adds the moments of another body, times a factor that is not negative.
    void add(const MomentBounds&, double factor);
};

/// Makes a body from its volume and from the moments of its mass, which are the integrals weighted with the density.
/// They give the mass, the centre of mass and the tensor of inertia. Coordinates of the moments are relative to
/// `origin`.
Body body_of(const Measured& volume, const MomentBounds& mass, const std::array<double, 3>& origin);

/// A number between two bounds, low ≤ high. The estimate is moved into the interval if it lies outside.
Measured measured(double low, double high, double estimate);

}  // namespace phasetree::measuring
