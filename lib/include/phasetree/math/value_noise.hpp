#pragma once

#include <utility>

#include "phasetree/math/lattice_hash.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree {

namespace lattice {

/// Perlin's quintic, which rises from 0 to 1 with t.
template <class T>
T fade(const T& t) {
    return t * t * t * (t * (t * 6.f - 15.f) + 10.f);
}
/// The number type of lattice points for coordinates of type T. Lattice points have no derivatives, so they are hashed
/// as plain numbers.
template <class T>
using Whole = decltype(whole_part(std::declval<T>()));
/// The position of a coordinate in the lattice: the lattice points below and above it, modulo 289 (lattice_hash.hpp),
/// and the weight of the upper one.
template <class T>
struct Coordinate {
    Whole<T> low, high;
    T blend;
};
template <class T>
Coordinate<T> coordinate(const T& u) {
    const Whole<T> whole = whole_part(u), low = wrapped(whole);
    return {low, low + 1.f, fade(u - whole)};
}
template <class Value, class T>
T mix(const Value& a, const Value& b, const T& blend) {
    return a + (b - a) * blend;
}
/// Map a hash, 0 … 288, to [−1, 1].
template <class T>
T centred(const T& hash) {
    return hash * (1.f / 144.f) - 1.f;
}

}  // namespace lattice

/// Value noise with a proven Lipschitz bound. Each point of the integer lattice has a value in [−1, 1]. In between, the
/// eight corners of a cell are blended along each axis with Perlin's quintic F(t) = t³(6t² − 15t + 10) (Perlin,
/// "Improving Noise", 2002).
///
/// *Slope.* Within a cell the noise is E[w], the mean of the corners' values under the product measure that gives the
/// upper corner along axis i the weight Fᵢ = F(tᵢ). Its derivative with respect to Fᵢ is E[w χᵢ]/σᵢ with σᵢ² = Fᵢ(1 −
/// Fᵢ) and χᵢ = (xᵢ − Fᵢ)/σᵢ, xᵢ ∈ {0, 1}. The χᵢ are orthonormal, so Σ E[w χᵢ]² ≤ E[w²] ≤ 1 by Bessel's inequality,
/// and
///     ‖∇‖² = Σ (F′ᵢ/σᵢ)² E[w χᵢ]² ≤ max F′²/(F(1 − F)).
/// With y = (t − ½)²: F′² = 900 (¼ − y)⁴ and F(1 − F) = (¼ − y)³ (16 − 33y + 36y²). The quotient 900 (¼ − y)/(16 − 33y
/// + 36y²) is at most 225/16, its value at y = 0, because 64y ≥ 33y − 36y². The slope is therefore at most 15/4. This
/// is reached in the middle of a cell between four corners of value 1 and four of −1.
template <class T>
T value_noise(const Vec3<T>& p) {
    using lattice::hashed, lattice::hashed_on, lattice::mix;
    const auto x = lattice::coordinate(p.x), y = lattice::coordinate(p.y), z = lattice::coordinate(p.z);
    const auto along_z = [&](const lattice::Whole<T>& row) {
        return mix(hashed(row + z.low), hashed(row + z.high), z.blend);
    };
    const auto along_yz = [&](const lattice::Whole<T>& slice) {
        return mix(along_z(hashed_on(slice + y.low)), along_z(hashed_on(slice + y.high)), y.blend);
    };
    return lattice::centred(mix(along_yz(hashed_on(x.low)), along_yz(hashed_on(x.high)), x.blend));
}

/// Value noise over the plane, with the same range and slope. The integer `which` selects one of 289 noises.
template <class T>
T value_noise(const T& x, const T& y, float which) {
    using lattice::hashed, lattice::hashed_on, lattice::mix;
    const auto cx = lattice::coordinate(x), cy = lattice::coordinate(y);
    const lattice::Whole<T> plane(hashed_on(lattice::wrapped(which)));
    const auto along_y = [&](const lattice::Whole<T>& row) {
        return mix(hashed(row + cy.low), hashed(row + cy.high), cy.blend);
    };
    return lattice::centred(mix(along_y(hashed_on(plane + cx.low)), along_y(hashed_on(plane + cx.high)), cx.blend));
}

}  // namespace phasetree
