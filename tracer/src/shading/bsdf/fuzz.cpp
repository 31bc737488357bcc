#include "shading/bsdf/fuzz.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

namespace {

// Λ by the fit of the course notes: exp of L below a cosine of 1/2, and of 2 L(1/2) − L(1 − cos θ) above.
class Masking {
  public:
    explicit Masking(float alpha) {
        constexpr std::array<float, 5> at_0{25.3245f, 3.32435f, 0.16801f, -1.27393f, -4.85967f};
        constexpr std::array<float, 5> at_1{21.5473f, 3.82987f, 0.19823f, -1.97760f, -4.32054f};
        const float part = (1.0f - alpha) * (1.0f - alpha);
        for (std::size_t i = 0; i < p_.size(); ++i) p_[i] = part * at_0[i] + (1.0f - part) * at_1[i];
    }
    float lambda(float cosine) const {
        return std::exp(cosine < 0.5f ? fit(cosine) : 2.0f * fit(0.5f) - fit(1.0f - cosine));
    }

  private:
    float fit(float x) const { return p_[0] / (1.0f + p_[1] * std::pow(x, p_[2])) + p_[3] * x + p_[4]; }

    std::array<float, 5> p_;
};

float distribution(float alpha, float cosine) {
    const float sine2 = std::max(0.0f, (1.0f - cosine) * (1.0f + cosine));
    return (2.0f + 1.0f / alpha) / (2.0f * pi) * std::pow(sine2, 0.5f / alpha);
}

// E(μ), by the midpoint rule in t = √μᵢ and in φ.
float directional_albedo(float alpha, float mu) {
    constexpr int rings = 96, spokes = 96;
    const Masking masking(alpha);
    const float sine_o = std::sqrt(std::max(0.0f, 1.0f - mu * mu)), lambda_o = masking.lambda(mu);
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / rings, z = t * t, sine = std::sqrt(1.0f - z * z);
        double ring = 0.0;
        for (int k = 0; k < spokes; ++k) {
            const float phi = pi * (static_cast<float>(k) + 0.5f) / spokes;
            const glm::vec3 m = glm::normalize(glm::vec3(sine_o + sine * std::cos(phi), sine * std::sin(phi), mu + z));
            ring += static_cast<double>(distribution(alpha, m.z));
        }
        const float others =
            2.0f * t / rings * 2.0f * pi / spokes / (4.0f * mu * (1.0f + lambda_o + masking.lambda(z)));
        sum += ring * static_cast<double>(others);
    }
    return static_cast<float>(sum);
}

}  // namespace

float Fuzz::alpha_of(float roughness) {
    return std::clamp(roughness * roughness, 0.07f, 1.0f);
}

LossTables Fuzz::losses_of(const ValueRange& alpha) {
    return {alpha, [](float a) { return LossTable([&](float mu) { return glm::vec3(directional_albedo(a, mu)); }); }};
}

float Fuzz::value(float alpha, const glm::vec3& wo, const glm::vec3& wi) {
    const Masking masking(alpha);
    const glm::vec3 m = glm::normalize(wo + wi);
    return distribution(alpha, m.z) / (4.0f * wo.z * (1.0f + masking.lambda(wo.z) + masking.lambda(wi.z)));
}

glm::vec3 Fuzz::sample(const glm::vec2& u) {
    return square_to_uniform_cone(u, 1.0f);
}

float Fuzz::pdf() {
    return uniform_cone_pdf(1.0f);
}

}  // namespace phasetree::tracer
