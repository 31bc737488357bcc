#pragma once

#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The centre line is (R cos θ, R sin θ, kθ), θ from 0 to 2πN, k = pitch/2π (moved down by half its height). For a
/// point with cylindrical coordinates (ρ, φ, z), turn n of the line and θ = φ + 2πn + x,
///     D² = (ρ − R)² + 4ρR sin²(x/2) + k² (x − M)²,   M = z/k − φ − 2πn,
/// is stationary where F(x) = x + e sin x − M = 0, e = ρR/k²: Kepler's equation.
///
/// *One turn.* Let M ≥ 0; M < 0 is its mirror image. On [0, π] F is concave, with F(0) ≤ 0. Its first root is a minimum
/// of D, its second a maximum; there is no other minimum in the turn. From the left of the first root of a concave
/// function, Newton's and Halley's iterations approach the root without passing it. Five steps of Halley's iteration
/// come within 2·10⁻⁷ R of the distance (worst where two turns are equally near and e = 1). If there is no root, any x
/// will do, because it is a point of the line.
///
/// *Which turn.* D at the minima grows with |M|, so without ends the turn with the smallest |M| ≤ π has the nearest
/// point. Let n₀ … n₁ be the turns whose middle x = 0 is between the ends. If the nearest turn's minimum is past the
/// upper end, the candidates are that end and turn n₁. The minimum of any lower turn has a larger D. If turn n₁ has no
/// minimum before the end, D decreases all the way to the end. Let ξ < 0 be the value of x at the end, measured from
/// the middle of turn n₁ + 1. That turn has a minimum before the end if and only if F(ξ) ≥ 0 and ξ > −π. The same holds
/// at the lower end. One solution of Kepler's equation and the two ends therefore give the exact distance.
struct Helix {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "helix", "", "√((ρ − R)² + 4ρR sin²(x/2) + k²(x − M)²) − r,  x + (ρR/k²) sin x = M,  or from an end",
        "A coil of round wire about the z axis with round ends, centred at half its height. It rises counter-clockwise "
        "as seen from above (right-handed) from its lower end, at y = 0 and x > 0. A left-handed coil is its mirror "
        "image across y = 0 and starts there, too. Exact where turns do not touch."};
    float radius = 1;
    float pitch = 0.5f;
    float turns = 3;
    float wire = 0.1f;
    float end_x = 1, end_y = 0;  ///< position of its end, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Helix::radius,
          Parameter{"radius", "m", "Distance of the wire's centre line from the axis.", limits::positive});
        v(&Helix::pitch,
          Parameter{"pitch", "m", "Height of one turn; negative for a left-handed coil; not zero.", limits::any});
        v(&Helix::turns, Parameter{"turns", "", "Number of turns, at least 1.", Limits{.low = 1, .high = 10000}});
        v(&Helix::wire, Parameter{"wire_radius", "m", "Radius of the wire.", limits::positive});
    }
    void prepare() {
        detail::require_usable(info.name, {radius, wire});
        if (!(std::abs(pitch) >= 1e-3f * radius))
            throw ModelError("helix: the pitch is less than a thousandth of the radius");
        if (!(std::abs(pitch) <= 1e3f * radius)) throw ModelError("helix: the pitch is more than a thousand radii");
        const double angle = 6.283185307179586 * turns;
        end_x = static_cast<float>(radius * std::cos(angle));
        end_y = static_cast<float>(radius * std::sin(angle));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        constexpr float pi = 3.14159265f, around = 6.28318531f;
        const T zero(0.f), one(1.f);
        const float rise = std::abs(pitch), k = rise / around, steepness = radius / (k * k);
        // Heights are measured from the lower end, and a left-handed coil is mirrored to a right-handed one.
        const T y = pitch < 0 ? -p.y : p.y, z = p.z + rise * turns * 0.5f;
        const T rho = length(p.x, y), e = min(rho * steepness, T(1e9f));

        // Measured in turns: the height, the angle, and the numbers n of the turns that pass at this angle.
        const T height = z * (1.f / rise), angle = angle_of(p.x, y) * (1.f / around);
        const T above = height - angle;
        const T lowest = -floor(angle), highest = floor(turns - angle);
        const T after = (turns - angle - (highest + one)) * around, before = -(angle + (lowest - one)) * around;
        const T sine_after = (p.x * (end_y / radius) - y * (end_x / radius)) * steepness;
        const T f_after = after + sine_after - (above - (highest + one)) * around;
        const T f_before = before - y * steepness - (above - (lowest - one)) * around;
        const T also_after = select(less(T(-pi), after), select(less(f_after, zero), zero, one), zero);
        const T also_before = select(less(before, T(pi)), select(less(zero, f_before), zero, one), zero);
        const T n = clamp(floor(above + 0.5f), lowest - also_before, highest + also_after);

        const T mean = (above - n) * around;
        const T m = abs(mean), m_used = min(m, T(1e6f));
        T x = m_used / (e + 1.f);
        for (int i = 0; i < 5; ++i) {
            const auto [s, c] = sine_cosine(x);
            const T f = x + e * s - m_used, slope = e * c + 1.f;
            const T next = x - f * slope / max(slope * slope + f * (e * s) * 0.5f, T(1e-12f));
            x = clamp(next, zero, T(pi));
        }
        const T half_sine = sine_cosine(x * 0.5f).sine, axial = (m - x) * k, radial = rho - radius;
        const T to_line = radial * radial + rho * (half_sine * half_sine) * (4.f * radius) + axial * axial;

        const auto squared = [](const T& a, const T& b, const T& c) { return a * a + b * b + c * c; };
        const T top = z - rise * turns;
        const T to_ends = min(squared(p.x - radius, y, z), squared(p.x - end_x, y - end_y, top));
        const T where = (angle + n) * around + select(less(mean, zero), -x, x);
        const T between = select(less(where, zero), to_ends, select(less(T(turns * around), where), to_ends, to_line));
        return sqrt(min(between, to_ends)) - wire;
    }
    /// The support of the cylinder that contains the coil.
    double support(const glm::dvec3& d, float level) const {
        const double half = 0.5 * static_cast<double>(std::abs(pitch) * turns);
        return detail::disk_support(d) * static_cast<double>(radius) + std::abs(d.z) * half +
               glm::length(d) * static_cast<double>(wire + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        if (wire + level < 0) return {};
        const float half = std::abs(pitch) * turns * 0.5f;
        return Bounds::centred(glm::vec3{radius, radius, half} * (1 + 1e-6f) + (wire + level));
    }
};

}  // namespace phasetree
