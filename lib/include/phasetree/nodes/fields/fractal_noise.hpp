#pragma once

#include "phasetree/nodes/fields/lattice_hash.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// Value noise with a proven slope. Each point of the integer lattice has a value in [−1, 1]; between them the eight
/// corners of a cell are blended by Perlin's quintic F(t) = t³(6t² − 15t + 10) along each axis (Perlin, "Improving
/// Noise", 2002).
///
/// *Slope.* Within a cell the noise is E[w], the mean of the corners' values under the product measure that gives
/// the upper corner along axis i the weight Fᵢ = F(tᵢ). Its derivative by Fᵢ is E[w χᵢ]/σᵢ with σᵢ² = Fᵢ(1 − Fᵢ) and
/// χᵢ = (xᵢ − Fᵢ)/σᵢ, xᵢ ∈ {0, 1}. The χᵢ are orthonormal, so by Bessel's inequality Σ E[w χᵢ]² ≤ E[w²] ≤ 1, and
///     ‖∇‖² = Σ (F′ᵢ/σᵢ)² E[w χᵢ]² ≤ max F′²/(F(1 − F)).
/// With y = (t − ½)²: F′² = 900 (¼ − y)⁴, F(1 − F) = (¼ − y)³ (16 − 33y + 36y²), and 900 (¼ − y)/(16 − 33y + 36y²) is
/// at most 225/16, its value at y = 0, because 64y ≥ 33y − 36y². So the slope is at most 15/4, which is reached in
/// the middle of a cell between four corners of value 1 and four of −1.
///
/// *Octaves* of half the size and half the weight add 15/4 each. The weights' sum is 1, the range [−1, 1].
///
/// *Positions* are projected onto a cube of 2¹⁷ sizes, which lengthens nothing; beyond it the noise is constant along
/// the cube's normals. So the lattice's hash (lattice_hash.hpp) gets numbers that it computes exactly.
///
/// distance() is the noise divided by its slope's bound, hence 1-Lipschitz, as every primitive.
struct FractalNoise {
    static constexpr bool is_long = true;  ///< a LongPrimitive
    float frequency = 1;                   ///< 1/size of the first octave
    float octaves = 1;
    float weight = 1 / steepest;  ///< of the first octave

    /// A bound of the slope of noise in [−1, 1].
    static float slope(float size, float octaves) { return steepest * octaves / (size * weights(octaves)); }

    FractalNoise() = default;
    FractalNoise(float size, float count) : frequency(1.f / size), octaves(count), weight(size / (steepest * count)) {}

    template <class T>
    T distance(const Vec3<T>& p) const {
        const T far(65536.f);
        T x = clamp(p.x * frequency, -far, far), y = clamp(p.y * frequency, -far, far),
          z = clamp(p.z * frequency, -far, far);
        float share = weight;
        T sum(0.f);
        for (int i = 0; i < static_cast<int>(octaves); ++i) {
            sum = sum + value(Vec3<T>{x, y, z}) * share;
            // Shifted, so that the octaves' lattices share no point.
            x = x * 2.f + 19.25f;
            y = y * 2.f + 47.375f;
            z = z * 2.f + 71.5625f;
            share *= 0.5f;
        }
        return sum;
    }

    /// Of the first octave.
    float period() const { return 1 / frequency; }

    /// What its second derivative along a line of unit speed is at most, within the cube. Of one octave: along an axis
    /// |F″| ≤ 10/√3 times a difference of two values, mixed (15/8)² times one of four; Gershgorin's rows add up.
    double curvature() const {
        constexpr double row = 2 * 5.7735027 + 2 * 4 * 3.515625;
        const double f = static_cast<double>(frequency);
        return static_cast<double>(weight) * f * f * row * (std::exp2(static_cast<double>(octaves)) - 1);
    }
    bool is_within_cube(double coordinate) const { return coordinate * static_cast<double>(frequency) < 65536; }

    /// One octave over the plane, of the same range and slope: for each whole number another one.
    template <class T>
    static T in_plane(const T& x, const T& y, float which) {
        using lattice::hashed, lattice::sum, lattice::wrapped;
        const Coordinate<T> cx = coordinate(x), cy = coordinate(y);
        const T plane(hashed(wrapped(which)));
        const auto along_y = [&](const T& row) {
            return mix(hashed(sum(row, cy.low)), hashed(sum(row, cy.high)), cy.blend);
        };
        const T low = along_y(hashed(sum(plane, cx.low))), high = along_y(hashed(sum(plane, cx.high)));
        return mix(low, high, cx.blend) * (1.f / 144.f) - 1.f;
    }

  private:
    static constexpr float steepest = 3.75f;

    /// Σ 2⁻ⁱ over the octaves.
    static float weights(float octaves) { return 2.f - std::exp2(1.f - octaves); }

    template <class T>
    struct Coordinate {
        T low, high;  ///< the lattice's coordinates modulo 289
        T blend;
    };
    template <class T>
    static Coordinate<T> coordinate(const T& u) {
        const T whole = floor(u), t = u - whole, low = lattice::wrapped(whole);
        const T next = low + 1.f;
        return {low, select(less(T(288.5f), next), T(0.f), next), t * t * t * (t * (t * 6.f - 15.f) + 10.f)};
    }
    template <class T>
    static T mix(const T& a, const T& b, const T& blend) {
        return a + (b - a) * blend;
    }
    template <class T>
    static T value(const Vec3<T>& p) {
        using lattice::hashed, lattice::sum;
        const Coordinate<T> x = coordinate(p.x), y = coordinate(p.y), z = coordinate(p.z);
        const auto along_z = [&](const T& row) {
            return mix(hashed(sum(row, z.low)), hashed(sum(row, z.high)), z.blend);
        };
        const auto along_yz = [&](const T& slice) {
            return mix(along_z(hashed(sum(slice, y.low))), along_z(hashed(sum(slice, y.high))), y.blend);
        };
        return mix(along_yz(hashed(x.low)), along_yz(hashed(x.high)), x.blend) * (1.f / 144.f) - 1.f;
    }
};

}  // namespace phasetree
