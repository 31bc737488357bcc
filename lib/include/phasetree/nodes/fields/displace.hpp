#pragma once

#include "phasetree/nodes/fields/fractal_noise.hpp"

namespace phasetree {

/// g = f + a n, where the noise n is in [−1, 1] with slope at most L (fractal_noise.hpp). So g/λ is 1-Lipschitz for λ =
/// 1 + a L. Because f − a ≤ g ≤ f + a, the bounds f ± a, which are 1-Lipschitz themselves, can take over:
///     min(max(g/λ, f − a), f + a)
/// has the sign of g everywhere. Near the surface g suffices; away from it the slope is that of f instead of f/λ. Where
/// f − a is larger, the noise need not be evaluated.
struct Displace {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"displace", "",
                                   "min(max((f + a n)/λ, f − a), f + a),  λ = 1 + a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)",
                                   "Displaces the surface of a field by fractal noise."};
    Field of{};
    float amplitude = 0.1f;
    float scale = 0.5f;
    float octaves = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Displace::of, Parameter{"of", "", "The field."});
        v(&Displace::amplitude, Parameter{"amplitude", "m", "Largest displacement, a.", limits::non_negative});
        v(&Displace::scale, Parameter{"scale", "m", "Size of the largest bumps.", limits::positive});
        v(&Displace::octaves,
          Parameter{"octaves", "", "Number of octaves of noise, each with half the size of the one before.",
                    Limits{.low = 1, .high = 6}, true});
    }
    void prepare() const {
        if (octaves != std::floor(octaves)) throw ModelError("displace: \"octaves\" must be a whole number");
        detail::require_usable(info.name, {scale});
        if (amplitude > 0) detail::require_usable(info.name, {amplitude});
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        const typename D::Scalar f = d.field(of, p);
        if (amplitude == 0) return f;
        const FractalNoise noise(scale, octaves);
        const float slope = amplitude * FractalNoise::slope(scale, octaves);
        const typename D::Scalar g = (f + d.primitive(noise, p) * slope) * (1.f / (1.f + slope));
        return far_bound_inside(far_bound(g, f - amplitude), f + amplitude);
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level + amplitude); }
};

}  // namespace phasetree
