#pragma once

#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/fields/fractal_noise.hpp"

namespace phasetree {

/// The ground below z = h(x, y). h sums octaves of plane value noise n, whose slope is at most 15/4, like that of noise
/// in space (math/value_noise.hpp). Each octave is shaped by (1 − r) n + r (1 − 2|n|), which stays in [−1, 1] and is
/// steeper by a factor of at most 1 + r. With L ≥ ‖∇h‖, the gradient of (z − h)/√(1 + L²) has length at most 1. Because
/// |h| ≤ a, the planes z − a and z + a, which have slope 1, can take over as in displace.hpp.
struct Heightfield {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "heightfield", "", "min(max((z − h)/√(1 + L²), z − a), z + a),  L = 15 a (1 + r) octaves/(4 size Σ 2⁻ⁱ)",
        "Terrain: the ground below a surface of fractal noise, infinite in x and y."};
    float size = 1;
    float amplitude = 0.25f;
    float octaves = 4;
    float ridged = 0;
    float seed = 0;
    float frequency = 1;  ///< 1/size, derived
    float share = 0.25f;  ///< amplitude of the first octave, derived
    float inverse = 1;    ///< 1/√(1 + L²), derived

    template <class V>
    static void parameters(V&& v) {
        v(&Heightfield::size, Parameter{"size", "m", "Size of the largest hills.", limits::positive});
        v(&Heightfield::amplitude,
          Parameter{"amplitude", "m", "Largest height above and depth below z = 0, a.", limits::non_negative});
        v(&Heightfield::octaves,
          Parameter{"octaves", "", "Number of octaves of hills, each with half the size of the one before.",
                    Limits{.low = 1, .high = 6}, true});
        v(&Heightfield::ridged,
          Parameter{"ridged", "", "From rolling hills, 0, to mountains with sharp ridges, 1.", limits::fraction, true});
        v(&Heightfield::seed,
          Parameter{"seed", "", "Seed of the landscape.", Limits{.low = -100000, .high = 100000}, true});
    }
    void prepare() {
        if (octaves != std::floor(octaves)) throw ModelError("heightfield: \"octaves\" must be a whole number");
        if (seed != std::floor(seed)) throw ModelError("heightfield: \"seed\" must be a whole number");
        detail::require_usable(info.name, {size});
        if (amplitude > 0) detail::require_usable(info.name, {amplitude});
        frequency = 1 / size;
        share = amplitude / (2.f - portable::exp2(1.f - octaves));
        const double slope = static_cast<double>(amplitude) * (1.0 + ridged) * FractalNoise::slope(size, octaves);
        inverse = static_cast<float>((1 - 1e-6) / std::sqrt(1 + slope * slope));
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T far(65536.f);
        T x = clamp(p.x * frequency, -far, far), y = clamp(p.y * frequency, -far, far);
        T height(0.f);
        float part = share;
        for (int i = 0; i < static_cast<int>(octaves); ++i) {
            const T n = value_noise(x, y, seed + 71.f * static_cast<float>(i));
            height = height + (n * (1.f - ridged) + (1.f - abs(n) * 2.f) * ridged) * part;
            x = x * 2.f + 19.25f;
            y = y * 2.f + 47.375f;
            part *= 0.5f;
        }
        return min(max((p.z - height) * inverse, p.z - amplitude), p.z + amplitude);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        return {glm::vec3(-Bounds::infinity), {Bounds::infinity, Bounds::infinity, amplitude + level}};
    }
};

}  // namespace phasetree
