#include "lights/diffuse_irradiance.hpp"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

#include "image/luminance.hpp"

namespace phasetree::tracer {

namespace {

constexpr int samples = 1024;

// The truncated series may approach 0 or become negative where some light still arrives. The irradiance is at least
// this share of what the same light would give if it came from all directions.
constexpr float least_share = 0.05f;

constexpr float least_unevenness = 0.1f;

std::array<float, 9> harmonics(const glm::vec3& w) {
    return {0.282095f,
            0.488603f * w.y,
            0.488603f * w.z,
            0.488603f * w.x,
            1.092548f * w.x * w.y,
            1.092548f * w.y * w.z,
            0.315392f * (3.0f * w.z * w.z - 1.0f),
            1.092548f * w.x * w.z,
            0.546274f * (w.x * w.x - w.y * w.y)};
}

// Point i of the Hammersley set of `samples` points, which are 2¹⁰.
glm::vec2 hammersley(int i) {
    unsigned reversed = 0;
    for (int bit = 0; bit < 10; ++bit) reversed |= ((static_cast<unsigned>(i) >> bit) & 1u) << (9 - bit);
    return {(static_cast<float>(i) + 0.5f) / samples, (static_cast<float>(reversed) + 0.5f) / samples};
}

}  // namespace

DiffuseIrradiance::DiffuseIrradiance(const InfiniteLight& any) {
    constexpr float pi = std::numbers::pi_v<float>;
    constexpr std::array<float, 9> cosine_lobe{pi,     2 * pi / 3, 2 * pi / 3, 2 * pi / 3, pi / 4,
                                               pi / 4, pi / 4,     pi / 4,     pi / 4};
    std::visit(
        [&](const auto& light) {
            least_ = least_share * 0.25f * light.fluence();
            const float mean = light.fluence() / (4 * pi);
            float above_mean = 0, all = 0;
            // Samples are taken in proportion to the light, so that a sun in an image is not missed.
            for (int i = 0; i < samples; ++i) {
                const auto sample = light.sample(hammersley(i));
                if (!sample || !(sample->pdf > 0.0f)) continue;
                const float seen = luminance(light.radiance(sample->direction));
                const float weight = seen / (sample->pdf * samples);
                above_mean += std::max(seen - mean, 0.0f) / (sample->pdf * samples);
                all += weight;
                const std::array<float, 9> y = harmonics(sample->direction);
                for (std::size_t k = 0; k < y.size(); ++k) coefficients_[k] += weight * cosine_lobe[k] * y[k];
            }
            if (all > 0.0f && std::isfinite(all)) unevenness_ = std::max(above_mean / all, least_unevenness);
        },
        any);
    for (float& c : coefficients_)
        if (!std::isfinite(c)) coefficients_ = {};
}

float DiffuseIrradiance::at(const glm::vec3& normal) const {
    const std::array<float, 9> y = harmonics(normal);
    float sum = 0;
    for (std::size_t k = 0; k < y.size(); ++k) sum += coefficients_[k] * y[k];
    return std::max(sum, least_);
}

}  // namespace phasetree::tracer
