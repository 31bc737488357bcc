#include "shading/bsdf/lost_energy.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

LossTable::LossTable(const std::function<glm::vec3(float)>& directional_albedo) {
    const auto cosine_at = [](double t) { return static_cast<float>(t * t); };
    for (std::size_t i = 0; i < nodes; ++i) {
        const float mu = cosine_at(static_cast<double>(i) / (nodes - 1));
        loss_[i] = glm::clamp(1.0f - directional_albedo(std::max(1e-4f, mu)), 0.0f, 1.0f);
    }
    // The midpoint rule in t = √μ; 2μ dμ = 4t³ dt.
    constexpr int steps = 32;
    glm::dvec3 sum(0.0);
    cumulative_[0] = 0.0f;
    for (std::size_t bin = 0; bin + 1 < nodes; ++bin) {
        glm::dvec3 in_bin(0.0);
        double weight = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double t = (static_cast<double>(bin) + (i + 0.5) / steps) / (nodes - 1);
            const double dmu2 = 4.0 * t * t * t / (static_cast<double>(steps) * (nodes - 1));
            in_bin += dmu2 * glm::dvec3(at(cosine_at(t)));
            weight += dmu2;
        }
        sum += in_bin;
        density_[bin] = mean_of_channels(glm::vec3(in_bin / weight));
    }
    average_ = glm::vec3(sum);
    // Where nothing is lost the lobe is never chosen; it is Lambert's then.
    if (!(mean_of_channels(average_) > 0.0f)) density_.fill(1.0f);
    for (std::size_t bin = 0; bin + 1 < nodes; ++bin) {
        const float low = cosine_at(static_cast<double>(bin) / (nodes - 1));
        const float high = cosine_at(static_cast<double>(bin + 1) / (nodes - 1));
        cumulative_[bin + 1] = cumulative_[bin] + density_[bin] * (high * high - low * low);
    }
    const float total = cumulative_.back();
    for (float& density : density_) density /= total;
    for (float& below : cumulative_) below /= total;
}

glm::vec3 LossTable::at(float cos_theta) const {
    const float position = std::sqrt(std::clamp(cos_theta, 0.0f, 1.0f)) * static_cast<float>(nodes - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), nodes - 2);
    return glm::mix(loss_[below], loss_[below + 1], position - static_cast<float>(below));
}

glm::vec3 LossTable::sample(const glm::vec2& u) const {
    const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u.x);
    const auto bin = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
    const float low = static_cast<float>(bin) / static_cast<float>(nodes - 1);
    const float high = static_cast<float>(bin + 1) / static_cast<float>(nodes - 1);
    const float mass = cumulative_[bin + 1] - cumulative_[bin];
    const float part = mass > 0.0f ? std::clamp((u.x - cumulative_[bin]) / mass, 0.0f, 1.0f) : 0.5f;
    // μ² is uniform between the nodes.
    const float low4 = low * low * low * low;
    const float high4 = high * high * high * high;
    const float mu2 = std::clamp(low4 + part * (high4 - low4), 1e-12f, 1.0f);
    const float sine = std::sqrt(1.0f - mu2);
    const float phi = 2.0f * pi * u.y;
    return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(mu2)};
}

float LossTable::pdf(float cos_theta) const {
    const float position = std::sqrt(std::clamp(cos_theta, 0.0f, 1.0f)) * static_cast<float>(nodes - 1);
    const std::size_t bin = std::min(static_cast<std::size_t>(position), nodes - 2);
    return density_[bin] * cosine_hemisphere_pdf(cos_theta);
}

LossTables::LossTables(const ValueRange& roughness, const std::function<LossTable(float)>& table) : nodes_(roughness) {
    if (nodes_.size() == 1)
        tables_.push_back(table(roughness.least));
    else
        for (std::size_t i = 0; i < nodes_.size(); ++i) tables_.push_back(table(nodes_.roughness(i)));
}

LossTables::At LossTables::at(float roughness) const {
    const auto [below, part] = nodes_.place(roughness);
    return {tables_[below], tables_[std::min(below + 1, tables_.size() - 1)], part};
}

glm::vec3 LossTables::At::at(float cos_theta) const {
    return glm::mix(below_->at(cos_theta), above_->at(cos_theta), part_);
}

glm::vec3 LossTables::At::average() const {
    return glm::mix(below_->average(), above_->average(), part_);
}

}  // namespace phasetree::tracer
