#include "shading/thin_pane.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "shading/bsdf/lobes.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer {

float ThinPane::Shares::choice_of_reflection() const {
    const float of_reflection = mean_of_channels(reflected), of_both = of_reflection + mean_of_channels(transmitted);
    return of_both > 0.0f ? of_reflection / of_both : 0.0f;
}

ThinPane::Shares ThinPane::at(float cos_theta) const {
    const auto [r, cos_inside] = fresnel_dielectric(cos_theta, eta_);
    // Nothing enters, and the quotients below may be 0/0.
    if (!(r < 1.0f) || !(cos_inside > 0.0f)) return {glm::vec3(1.0f), glm::vec3(0.0f)};
    Shares shares;
    for (int i = 0; i < 3; ++i) {
        const float a = colour_[i] == 1.0f ? 1.0f : std::pow(colour_[i], 1.0f / cos_inside);
        // 1 − r² a², without cancellation for grazing light
        const float rest = a == 1.0f ? (1.0f - r) * (1.0f + r) : 1.0f - r * r * a * a;
        shares.transmitted[i] = (1.0f - r) * (1.0f - r) * a / rest;
        shares.reflected[i] = a == 1.0f ? 2.0f * r / (1.0f + r) : r + r * a * shares.transmitted[i];
    }
    return shares;
}

ThinPane::Shares ThinPane::under_uniform_light() const {
    // Gauss-Legendre quadrature with 8 points on [0, 1], for functions of s with μ = s²; dμ² = 4 s³ ds.
    constexpr std::array<std::pair<float, float>, 4> points{{{0.18343464f, 0.36268378f},
                                                             {0.52553241f, 0.31370665f},
                                                             {0.79666648f, 0.22238103f},
                                                             {0.96028986f, 0.10122854f}}};
    Shares sum{glm::vec3(0.0f), glm::vec3(0.0f)};
    float weights = 0.0f;
    for (const auto& [x, weight] : points)
        for (const float s : {0.5f * (1.0f - x), 0.5f * (1.0f + x)}) {
            const float w = 0.5f * weight * 4.0f * s * s * s;
            const Shares here = at(s * s);
            sum.reflected += w * here.reflected;
            sum.transmitted += w * here.transmitted;
            weights += w;
        }
    return {sum.reflected / weights, sum.transmitted / weights};
}

}  // namespace phasetree::tracer
