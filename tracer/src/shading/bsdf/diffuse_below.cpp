#include "shading/bsdf/diffuse_below.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/rough_diffuse.hpp"

namespace phasetree::tracer {

DiffuseBelow::DiffuseBelow(const DielectricLayer::At& layer, const glm::vec3& color, float roughness)
    : color_(color), roughness_(roughness) {
    if (!(roughness_ > 0.0f)) return;
    a_ = RoughDiffuseBsdf::single_scattering(roughness_);
    over_average_ = 1.0f / glm::max(layer.average_entering(), glm::vec3(1e-6f));
    // Midpoint rule in t = √μ; 2μ dμ = 4t³ dt.
    constexpr int steps = 32;
    glm::vec3 z(0.0f);
    for (int i = 0; i < steps; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / steps;
        const RoughDiffuseTable::Row row = layer.rough_base(t * t);
        z += 4.0f * t * t * t / steps * row.entering * over_average_ * lost(row.oren_nayar);
    }
    multiple_ = color_ * color_ * (1.0f - z) / ((1.0f - color_ * z) * glm::max(z, glm::vec3(1e-7f)));
}

glm::vec3 DiffuseBelow::lost(const glm::vec3& oren_nayar) const {
    return glm::max(1.0f - a_ * (1.0f + roughness_ * oren_nayar * over_average_), glm::vec3(0.0f));
}

glm::vec3 DiffuseBelow::evaluate(const DielectricLayer::At& layer, const glm::vec3& wo, const glm::vec3& wi) const {
    const glm::vec3 through = layer.entering(wo) * layer.leaving(wi) * cosine_hemisphere_pdf(wi.z);
    if (!(roughness_ > 0.0f)) return color_ * through;
    const float s = glm::dot(wo, wi) - wo.z * wi.z;
    const float t = s > 0.0f ? std::max(wo.z, wi.z) : 1.0f;
    const glm::vec3 again = lost(layer.rough_base(wo.z).oren_nayar) * lost(layer.rough_base(wi.z).oren_nayar);
    return through * (color_ * (a_ * (1.0f + roughness_ * s / t)) + multiple_ * again);
}

}  // namespace phasetree::tracer
