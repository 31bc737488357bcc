#include "shading/bsdf/rough_diffuse_table.hpp"

#include <algorithm>
#include <cmath>

#include "sampling/warps.hpp"
#include "shading/bsdf/rough_diffuse.hpp"

namespace phasetree::tracer {

namespace {

// The midpoint rule in t = √μ, in which T and H are smooth.
constexpr int steps = 512;

float cosine_of_step(int i) {
    const float t = (static_cast<float>(i) + 0.5f) / steps;
    return t * t;
}
float width_of_step(int i) {
    return 2.0f * (static_cast<float>(i) + 0.5f) / (float{steps} * steps);
}

float sine_of(float cosine) {
    return std::sqrt(std::max(0.0f, (1.0f - cosine) * (1.0f + cosine)));
}

}  // namespace

RoughDiffuseTable::RoughDiffuseTable(const LossTables::At& entering) {
    constexpr int azimuths = 16;
    std::array<glm::vec3, steps> mean;
    const auto mean_at = [&](float mu) {
        glm::vec3 sum(0.0f);
        for (int i = 0; i < azimuths; ++i) {
            const float phi = 0.5f * pi * (static_cast<float>(i) + 0.5f) / azimuths;
            sum += entering.at(sine_of(mu) * glm::vec3(std::cos(phi), std::sin(phi), 0.0f) + glm::vec3(0, 0, mu));
        }
        return sum / float{azimuths};
    };
    for (int i = 0; i < steps; ++i) mean[static_cast<std::size_t>(i)] = mean_at(cosine_of_step(i));
    for (std::size_t k = 0; k < nodes; ++k) {
        const float root = static_cast<float>(k) / (nodes - 1), mu_o = root * root;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < steps; ++i) {
            const float mu = cosine_of_step(i);
            sum += glm::dvec3(mean[static_cast<std::size_t>(i)] *
                              ((1.0f / std::max(mu_o, mu) - 1.0f) * mu * sine_of(mu) * width_of_step(i)));
        }
        rows_[k] = {mean_at(mu_o), 2.0f / pi * sine_of(mu_o) * glm::vec3(sum)};
    }
}

RoughDiffuseTable::Row RoughDiffuseTable::at(float mu) const {
    const float position = std::sqrt(std::clamp(mu, 0.0f, 1.0f)) * static_cast<float>(nodes - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), nodes - 2);
    return rows_[below].mixed(rows_[below + 1], position - static_cast<float>(below));
}

RoughDiffuseTable::Row RoughDiffuseTable::of_white(float mu) {
    return {glm::vec3(1.0f), glm::vec3(RoughDiffuseBsdf::oren_nayar_integral(mu) / pi)};
}

RoughDiffuseTables::RoughDiffuseTables(const ValueRange& roughness, const LossTables& entering) : nodes_(roughness) {
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        tables_.emplace_back(entering.at(nodes_.size() == 1 ? roughness.least : nodes_.roughness(i)));
}

RoughDiffuseTable::Row RoughDiffuseTables::at(float roughness, float mu) const {
    const auto [below, part] = nodes_.place(roughness);
    const RoughDiffuseTable::Row row = tables_[below].at(mu);
    return part > 0.0f ? row.mixed(tables_[below + 1].at(mu), part) : row;
}

}  // namespace phasetree::tracer
