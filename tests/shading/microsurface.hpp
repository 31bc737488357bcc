// An oracle for rough surfaces: a random walk on Smith's microsurface of GGX normals, which follows light through all
// its scattering events. It shares with the BSDFs only the sampling of visible normals and Fresnel's equations.
//
// Heights are uniform in [−1, 1], with C(h) = (h + 1)/2. A ray at height h in direction w escapes with probability
// C(h)^Λ(w). Otherwise it meets the surface at the height h′ with C(h′) = C(h) / (1 − U)^(1/Λ(w)), where U is uniform.
// Downward rays have Λ < −1, and always meet the surface.
//
// Reference: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith Model, SIGGRAPH
// 2016, sections 4 and 5.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/fresnel.hpp"
#include "support/uniform.hpp"

namespace phasetree::tests {

class Microsurface {
  public:
    explicit Microsurface(float alpha) : Microsurface(alpha, alpha) {}
    // Of brushed metal with strokes along x.
    Microsurface(float along_x, float along_y) : along_x_(along_x), along_y_(along_y), ggx_(along_x, along_y) {}

    // How light that arrives from wo leaves. `bounces` counts its reflections at normals. `transmitted` is the side on
    // which it leaves, for a dielectric with this relative index. nullopt after a thousand reflections.
    struct Left {
        glm::vec3 direction;
        glm::vec3 weight;
        int scatterings;
        bool transmitted;
    };

    // fresnel(cos) is the reflectance of a metal.
    template <class Fresnel>
    std::optional<Left> reflect(const glm::vec3& wo, const Fresnel& fresnel, Uniform& uniform) const {
        glm::vec3 ray = -wo;
        glm::vec3 weight(1.0f);
        double height = 1.0;
        for (int scatterings = 0; scatterings < 1000; ++scatterings) {
            const std::optional<double> met = meets(ray, height, static_cast<double>(uniform()));
            if (!met) return Left{ray, weight, scatterings, false};
            height = *met;
            const float first = uniform();
            const glm::vec3 m = ggx_.sample_visible_normal(-ray, {first, uniform()});
            const float cosine = glm::dot(-ray, m);
            weight *= fresnel(cosine);
            ray = glm::normalize(ray + 2.0f * cosine * m);
        }
        return std::nullopt;
    }

    std::optional<Left> scatter(const glm::vec3& wo, float eta, Uniform& uniform) const {
        glm::vec3 ray = -wo;
        double height = 1.0;
        bool outside = true;
        for (int scatterings = 0; scatterings < 1000; ++scatterings) {
            // Seen from inside, the surface is upside down.
            const float up = outside ? 1.0f : -1.0f;
            const std::optional<double> met =
                meets(up * ray, static_cast<double>(up) * height, static_cast<double>(uniform()));
            if (!met) return Left{ray, glm::vec3(1.0f), scatterings, !outside};
            height = static_cast<double>(up) * *met;
            const float first = uniform();
            const glm::vec3 m = up * ggx_.sample_visible_normal(-up * ray, {first, uniform()});
            const float cosine = glm::dot(-ray, m);
            const float relative = outside ? eta : 1.0f / eta;
            const auto [reflectance, cos_transmitted] = tracer::fresnel_dielectric(cosine, relative);
            if (uniform() < reflectance) {
                ray = glm::normalize(ray + 2.0f * cosine * m);
            } else {
                ray = glm::normalize(ray / relative + (cosine / relative - cos_transmitted) * m);
                outside = !outside;
            }
        }
        return std::nullopt;
    }

  private:
    double lambda(const glm::vec3& w) const {
        const double z = static_cast<double>(w.z);
        const double x = static_cast<double>(along_x_) * static_cast<double>(w.x) / z;
        const double y = static_cast<double>(along_y_) * static_cast<double>(w.y) / z;
        const double tan2 = x * x + y * y;
        return 0.5 * (std::copysign(std::sqrt(1.0 + tan2), z) - 1.0);
    }

    // The height at which a ray meets the surface; nullopt if it escapes.
    std::optional<double> meets(const glm::vec3& w, double height, double u) const {
        const double below = std::clamp(0.5 * (height + 1.0), 0.0, 1.0);
        if (w.z > 0.99999f) return std::nullopt;
        if (w.z < -0.99999f) return 2.0 * u * below - 1.0;
        if (std::abs(w.z) < 1e-5f) return height;
        const double l = lambda(w);
        if (w.z > 0.0f && u > 1.0 - std::pow(below, l)) return std::nullopt;
        return 2.0 * std::clamp(below / std::pow(1.0 - u, 1.0 / l), 0.0, 1.0) - 1.0;
    }

    float along_x_, along_y_;
    tracer::Ggx ggx_;
};

}  // namespace phasetree::tests
