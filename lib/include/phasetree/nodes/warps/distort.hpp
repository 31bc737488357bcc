#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/fractal_noise.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The child is evaluated at a displaced point: ω⁻¹(p) = p + a (n₁, n₂, n₃), the same noise at three places far apart.
/// Each row of the noise's Jacobian is at most aL long, so its norm is at most √3 aL.
struct Distort {
    static constexpr NodeInfo info{"distort", "6",
                                   "φ(p + a (n(p), n(p + u), n(p + v)))/λ,  λ = 1 + √3 a L,  "
                                   "L = 15 octaves/(4 scale Σ 2⁻ⁱ)",
                                   "Distorts space by fractal noise, as in rock or smoke."};
    float amplitude = 0.1f;
    float scale = 1;
    float octaves = 1;

    struct Map {
        FractalNoise noise;
        float factor;  ///< a L, because the noise is already divided by its slope
        float apart;   ///< distance between the places of two components

        template <class T>
        Vec3<T> operator()(const Vec3<T>& p) const {
            const auto moved = [&](const T& x, float k) {
                const glm::vec3 shift(k * apart, 0.37f * k * apart, -0.73f * k * apart);
                return x + noise.distance(p + shift) * factor;
            };
            return {moved(p.x, 0), moved(p.y, 1), moved(p.z, 2)};
        }
    };

    template <class V>
    static void parameters(V&& v) {
        v(&Distort::amplitude,
          Parameter{"amplitude", "m", "Largest displacement along each axis, a.", limits::non_negative});
        v(&Distort::scale, Parameter{"scale", "m", "Size of the largest swirls.", limits::positive});
        v(&Distort::octaves,
          Parameter{"octaves", "", "Number of octaves of swirls, each with half the size of the one before.",
                    Limits{.low = 1, .high = 6}, true});
    }
    void prepare() const {
        if (octaves != std::floor(octaves)) throw ModelError("distort: \"octaves\" must be a whole number");
        detail::require_usable(info.name, {scale});
        if (amplitude > 0) detail::require_usable(info.name, {amplitude});
    }
    Map map() const { return {FractalNoise(scale, octaves), amplitude * slope(), 57.3f * scale}; }
    float value_scale() const { return 1 / (1 + 1.7320509f * amplitude * slope()); }
    Bounds image(const Bounds& b) const { return b.inflated(amplitude * (1 + 1e-6f)); }
    glm::dvec3 towards(const glm::dvec3& d) const { return d; }
    double beyond(const glm::dvec3& d) const { return detail::box_support(d, glm::dvec3(amplitude)); }

  private:
    float slope() const { return FractalNoise::slope(scale, octaves); }
};

}  // namespace phasetree
