#include "page/look.hpp"

#include <algorithm>
#include <cmath>

#include "image/srgb.hpp"

namespace phasetree::tracer {

namespace {

// The mean of a texture over points throughout the bounds.
glm::vec3 mean(const Texture& texture, const Bounds& b) {
    constexpr int along = 5;
    glm::vec3 sum(0);
    for (int i = 0; i < along * along * along; ++i) {
        const glm::vec3 at(static_cast<float>(i % along), static_cast<float>(i / along % along),
                           static_cast<float>(i / along / along));
        sum += color_at(texture, b.low + (at + 0.37f) / static_cast<float>(along) * (b.high - b.low));
    }
    return sum / static_cast<float>(along * along * along);
}

// The reflectance of a deep, diffusely lit layer of a scattering medium: van de Hulst's fit for the half-space with the
// similarity s = √((1 − α)/(1 − αg)), where α is the albedo (Multiple Light Scattering 2, 1980).
glm::vec3 reflectance(const ScatteringCoefficients& medium) {
    const glm::vec3 albedo = medium.scattering / glm::max(medium.extinction(), glm::vec3(1e-6f));
    const glm::vec3 s =
        glm::sqrt((1.f - albedo) / glm::max(1.f - albedo * medium.phase_function.mean_cosine(), glm::vec3(1e-6f)));
    return (1.f - s) * (1.f - 0.139f * s) / (1.f + 1.17f * s);
}

// The reflectance of metal at normal incidence.
glm::vec3 reflectance(const Conductor& c) {
    const glm::vec3 k2 = c.k * c.k, less = c.eta - 1.f, more = c.eta + 1.f;
    return (less * less + k2) / (more * more + k2);
}

// Shows the colour of a light, however bright it is.
void show_light(const glm::vec3& light, Look& look) {
    look.kind = Look::glowing;
    look.color = light * std::min(1.f, 3.f / std::max({light.x, light.y, light.z, 1e-6f}));
}

// The mean density of a medium in a box, sampled at 8³ points.
float mean_density(const VaryingMedium& medium, const Bounds& box) {
    float sum = 0;
    for (int row = 0; row < 64; ++row) {
        PointBatch points;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::vec3 share(static_cast<float>(i), static_cast<float>(row % 8), static_cast<float>(row / 8));
            const glm::vec3 p = box.low + (share + 0.5f) / 8.0f * box.extent();
            points.x[i] = p.x, points.y[i] = p.y, points.z[i] = p.z;
        }
        const BatchOfFloats densities = medium.densities_at(points);
        for (std::size_t i = 0; i < batch_size; ++i) sum += densities[i] / 512;
    }
    return sum;
}

// Shows the medium inside a clear phase. Flames glow, and scattering media look like a diffuse surface, unless they are
// so thin that most light passes half of the object. A varying density is shown as its mean.
void show(const Medium& interior, const Bounds& bounds, Look& look) {
    constexpr float thin = 0.5f;
    const auto* varying = std::get_if<VaryingMedium>(&interior);
    const float density = varying ? mean_density(*varying, bounds) : 1.0f;
    look.absorption = density * extinction(interior);
    std::visit(
        [&](const auto& medium) {
            if constexpr (requires { medium.coefficients(); }) {
                const ScatteringCoefficients& c = medium.coefficients();
                const float half_size = 0.5f * bounds.diagonal();
                const float scattered =
                    density * std::max({c.scattering.x, c.scattering.y, c.scattering.z}) * half_size;
                if (is_emissive(interior) && !c.scatters()) {
                    const glm::vec3 emission = light_of(c.emission, c.emission_spectrum, nullptr);
                    show_light(emission / glm::max(c.extinction(), glm::vec3(1e-6f)), look);
                } else if (scattered > thin) {
                    look.kind = Look::diffuse;
                    look.color = reflectance(c);
                }
            }
        },
        interior);
}

}  // namespace

Look look_of(const std::string& name, const Material& material, const Bounds& bounds) {
    Look look{name};
    std::visit(
        [&]<class Kind>(const Kind& m) {
            if constexpr (requires { m.interior; }) {
                look.ior = m.ior;
                show(m.interior, bounds, look);
            } else if constexpr (requires { m.metalness; }) {
                const bool is_metal = number_at(m.metalness, TexturePoint(bounds.centre())) >= 0.5f;
                look.kind = is_metal ? Look::metal : Look::coated;
                look.color = number_at(m.base_weight, TexturePoint(bounds.centre())) * mean(m.color, bounds);
                if (glows(material)) {
                    const Glowing& emission = *m.emission;
                    show_light(emission.radiance * light_of(mean(emission.light, bounds), emission.spectrum, nullptr),
                               look);
                }
            } else if constexpr (requires { m.eta; }) {
                look.kind = Look::metal;
                look.color = m.reflectance ? mean(*m.reflectance, bounds) : reflectance(m);
            } else if constexpr (requires { m.amount; }) {
                // A page shows only one material: the dominant one at the centre of the object.
                const bool is_second = number_at(m.amount, TexturePoint(bounds.centre())) >= 0.5f;
                look = look_of(name, is_second ? m.of->second : m.of->first, bounds);
            } else if constexpr (std::is_same_v<Kind, TwoSided>) {
                look = look_of(name, m.of->first, bounds);
            } else if constexpr (requires { m.light; }) {
                show_light(m.radiance * light_of(mean(m.light, bounds), m.spectrum, nullptr), look);
            } else {
                look.kind = requires {
                    m.ior;
                }
                ? Look::coated : Look::diffuse;
                look.color = mean(m.color, bounds);
            }
        },
        material);
    return look;
}

std::array<int, 3> shown_color(const Look& look) {
    const glm::vec3 c = look.kind == Look::clear ? glm::exp(-0.3f * look.absorption) : look.color;
    return {srgb_code(c.x), srgb_code(c.y), srgb_code(c.z)};
}

}  // namespace phasetree::tracer
