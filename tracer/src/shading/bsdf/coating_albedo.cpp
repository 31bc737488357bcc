#include "shading/bsdf/coating_albedo.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sampling/ggx.hpp"
#include "shading/bsdf/visible_normals.hpp"

namespace phasetree::tracer {

namespace {

// 2 ∫ E(μ) μ dμ by the midpoint rule in t = √μ, where E is smooth up to the critical angle: 2μ dμ = 4t³ dt.
template <class Directional>
glm::vec3 average_of(const Directional& directional) {
    constexpr int steps = 4096;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps;
        sum += 4.0 * t * t * t * glm::dvec3(directional(static_cast<float>(t * t)));
    }
    return glm::clamp(glm::vec3(sum / static_cast<double>(steps)), 0.0f, 1.0f);
}

// The number of intervals, at most this wide, into which a range is divided.
int intervals_of(const ValueRange& range, float widest) {
    const float width = range.greatest - range.least;
    return width > 0.0f ? static_cast<int>(std::ceil(width / widest)) : 0;
}

}  // namespace

CoatingAlbedo::CoatingAlbedo(const DielectricSurface& surface, const ValueRange& roughness,
                             const ValueRange& film_thickness)
    : surface_(surface),
      roughnesses_(roughness),
      middle_thickness_(film_thickness.middle()),
      thickness_(film_thickness) {
    if (roughness.greatest > 0.0f) {
        if (roughnesses_.size() == 1)
            tables_.push_back(table_of(roughness.least));
        else
            for (std::size_t i = 0; i < roughnesses_.size(); ++i)
                tables_.push_back(table_of(roughnesses_.roughness(i)));
    }
    if (roughness.least > 0.0f) return;
    const int intervals = intervals_of(film_thickness, 4.0f);
    for (int i = 0; i <= intervals; ++i) {
        const float thickness = glm::mix(film_thickness.least, film_thickness.greatest,
                                         static_cast<float>(i) / static_cast<float>(std::max(intervals, 1)));
        smooth_averages_.push_back(average_of([&](float mu) { return surface_.fresnel(mu, thickness).reflectance; }));
    }
}

// Mean over visible normals of F G₂/G₁: the single-scattering albedo of the rough coating.
CoatingAlbedo::Table CoatingAlbedo::table_of(float roughness) const {
    const Ggx ggx(roughness);
    Table table;
    for (std::size_t i = 0; i < nodes; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(nodes - 1);
        const float mu = std::max(1e-4f, t * t);
        if (roughness > 0.0f)
            table.directional[i] = mean_over_visible_normals(ggx, mu, [&](const glm::vec3& wo, const glm::vec3& m) {
                const float cos_o = glm::dot(wo, m);
                const glm::vec3 wi = 2.0f * cos_o * m - wo;
                if (!(wi.z > 0.0f)) return glm::vec3(0.0f);
                return surface_.fresnel(cos_o, middle_thickness_).reflectance * ggx.shadowing_of_reflected(wo, wi);
            });
        else
            table.directional[i] = surface_.fresnel(mu, middle_thickness_).reflectance;
        table.directional[i] = glm::clamp(table.directional[i], 0.0f, 1.0f);
    }
    table.average = average_of([&](float mu) { return in_table(table, mu); });
    return table;
}

glm::vec3 CoatingAlbedo::in_table(const Table& table, float cos_theta) {
    const float position = std::sqrt(cos_theta) * static_cast<float>(nodes - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), nodes - 2);
    return glm::mix(table.directional[below], table.directional[below + 1], position - static_cast<float>(below));
}

CoatingAlbedo::At::At(const CoatingAlbedo& albedo, float roughness, float thickness, const Wavelengths* wavelengths)
    : albedo_(&albedo), roughness_(roughness), thickness_(thickness), wavelengths_(wavelengths) {
    if (roughness_ > 0.0f) {
        thickness_ = albedo.middle_thickness_;
        const RoughnessNodes::Place place = albedo.roughnesses_.place(roughness);
        below_ = place.below;
        part_ = place.part;
        average_ = albedo.tables_[below_].average;
        if (part_ > 0.0f) average_ = glm::mix(average_, albedo.tables_[below_ + 1].average, part_);
        return;
    }
    const std::vector<glm::vec3>& averages = albedo.smooth_averages_;
    average_ = averages.front();
    if (averages.size() == 1) return;
    const ValueRange& range = albedo.thickness_;
    const auto last = static_cast<float>(averages.size() - 1);
    const float position = std::clamp((thickness - range.least) / (range.greatest - range.least), 0.0f, 1.0f) * last;
    const std::size_t below = std::min(static_cast<std::size_t>(position), averages.size() - 2);
    average_ = glm::mix(averages[below], averages[below + 1], position - static_cast<float>(below));
}

glm::vec3 CoatingAlbedo::At::directional(float cos_theta) const {
    const float mu = std::clamp(cos_theta, 0.0f, 1.0f);
    if (albedo_->surface_.is_none()) return glm::vec3(0.0f);
    if (!(roughness_ > 0.0f)) return fresnel(mu);
    const glm::vec3 below = in_table(albedo_->tables_[below_], mu);
    return for_light(part_ > 0.0f ? glm::mix(below, in_table(albedo_->tables_[below_ + 1], mu), part_) : below,
                     wavelengths_);
}

glm::vec3 CoatingAlbedo::At::internal() const {
    const float eta = albedo_->surface_.eta();
    return glm::clamp(1.0f - (1.0f - average()) / (eta * eta), 0.0f, 1.0f);
}

}  // namespace phasetree::tracer
