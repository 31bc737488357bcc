#include "shading/bsdf/lost_energy.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "phasetree/math/float_mode.hpp"
#include "sampling/warps.hpp"
#include "shading/bsdf/lobes.hpp"

namespace phasetree::tracer {

namespace {

float cosine_at(double t) {
    return static_cast<float>(t * t);
}

// 1 − E at all nodes of μ.
template <std::size_t nodes, class Albedo>
std::array<glm::vec3, nodes> row_of(const Albedo& albedo) {
    std::array<glm::vec3, nodes> row;
    for (std::size_t i = 0; i < nodes; ++i) {
        const float mu = cosine_at(static_cast<double>(i) / (nodes - 1));
        row[i] = glm::clamp(1.0f - albedo(std::max(1e-4f, mu)), 0.0f, 1.0f);
    }
    return row;
}

// The row below some |sin φ|, and the fraction towards the next. Rows are dense near 0, where the roughness along a
// direction changes fastest if it is much less along the grain than across.
struct AzimuthPlace {
    std::size_t below;
    float part;
};
AzimuthPlace azimuth_place(float sin_phi, std::size_t rows) {
    const float position = std::sqrt(std::min(sin_phi, 1.0f)) * static_cast<float>(rows - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), rows - 2);
    return {below, position - static_cast<float>(below)};
}

// Catmull-Rom spline through four equidistant values; `part` is 0 at b and 1 at c.
glm::vec3 cubic_through(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d, float part) {
    return b + 0.5f * part * (c - a + part * (2.0f * a - 5.0f * b + 4.0f * c - d + part * (3.0f * (b - c) + d - a)));
}

}  // namespace

LossTable::LossTable(const std::function<glm::vec3(float)>& directional_albedo) {
    const Row row = row_of<nodes>(directional_albedo);
    *this = LossTable(std::vector<Row>{row}, row);
}

LossTable::LossTable(const std::function<glm::vec3(float, float)>& directional_albedo) {
    // E is computed at few azimuths because each costs an integral. The rows between them are interpolated by cubics.
    constexpr std::size_t coarse = 13, rows_per_known = (azimuths - 1) / (coarse - 1);
    std::vector<Row> known;
    for (std::size_t k = 0; k < coarse; ++k) {
        const float root = static_cast<float>(k) / (coarse - 1), sin_phi = root * root;
        known.push_back(row_of<nodes>([&](float mu) { return directional_albedo(mu, sin_phi); }));
    }
    std::vector<Row> rows(azimuths);
    for (std::size_t k = 0; k < azimuths; ++k) {
        const std::size_t below = std::min(k / rows_per_known, coarse - 2);
        const float part = static_cast<float>(k - rows_per_known * below) / rows_per_known;
        for (std::size_t j = 0; j < nodes; ++j) {
            const glm::vec3 &b = known[below][j], &c = known[below + 1][j];
            const glm::vec3 a = below > 0 ? known[below - 1][j] : 2.0f * b - c;
            const glm::vec3 d = below + 2 < coarse ? known[below + 2][j] : 2.0f * c - b;
            rows[k][j] = glm::clamp(cubic_through(a, b, c, d, part), 0.0f, 1.0f);
        }
    }
    // The mean over φ. A quarter turn is enough by symmetry.
    constexpr int steps = 1024;
    Row mean;
    mean.fill(glm::vec3(0.0f));
    for (int i = 0; i < steps; ++i) {
        const auto [below, part] =
            azimuth_place(std::sin(0.5f * pi * (static_cast<float>(i) + 0.5f) / steps), azimuths);
        for (std::size_t j = 0; j < nodes; ++j)
            mean[j] += glm::mix(rows[below][j], rows[below + 1][j], part) / float{steps};
    }
    *this = LossTable(std::move(rows), mean);
}

LossTable::LossTable(std::vector<Row> rows, const Row& mean) : rows_(std::move(rows)) {
    // Midpoint rule in t = √μ; 2μ dμ = 4t³ dt.
    constexpr int steps = 32;
    glm::dvec3 sum(0.0);
    cumulative_[0] = 0.0f;
    for (std::size_t bin = 0; bin + 1 < nodes; ++bin) {
        glm::dvec3 in_bin(0.0);
        double weight = 0.0;
        for (int i = 0; i < steps; ++i) {
            const double t = (static_cast<double>(bin) + (i + 0.5) / steps) / (nodes - 1);
            const double dmu2 = 4.0 * t * t * t / (static_cast<double>(steps) * (nodes - 1));
            in_bin += dmu2 * glm::dvec3(at(mean, cosine_at(t)));
            weight += dmu2;
        }
        sum += in_bin;
        density_[bin] = mean_of_channels(glm::vec3(in_bin / weight));
    }
    average_ = glm::vec3(sum);
    // Without losses the lobe is never chosen; its pdf is then Lambert's.
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

glm::vec3 LossTable::at(const Row& row, float cos_theta) {
    const float position = std::sqrt(std::clamp(cos_theta, 0.0f, 1.0f)) * static_cast<float>(nodes - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), nodes - 2);
    return glm::mix(row[below], row[below + 1], position - static_cast<float>(below));
}

glm::vec3 LossTable::at(float cos_theta) const {
    return at(rows_.front(), cos_theta);
}

glm::vec3 LossTable::at(const glm::vec3& w) const {
    if (rows_.size() == 1) return at(w.z);
    const float sine = std::sqrt(w.x * w.x + w.y * w.y);
    const auto [below, part] = azimuth_place(sine > 0.0f ? std::abs(w.y) / sine : 0.0f, rows_.size());
    return glm::mix(at(rows_[below], w.z), at(rows_[below + 1], w.z), part);
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
    std::vector<std::optional<LossTable>> made(nodes_.size());
    tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t i) {
        const FlushSubnormals flush;
        made[i].emplace(table(made.size() == 1 ? roughness.least : nodes_.roughness(i)));
    });
    for (std::optional<LossTable>& one : made) tables_.push_back(std::move(*one));
}

LossTables::At LossTables::at(float roughness) const {
    const auto [below, part] = nodes_.place(roughness);
    return {tables_[below], tables_[std::min(below + 1, tables_.size() - 1)], part};
}

glm::vec3 LossTables::At::at(float cos_theta) const {
    return glm::mix(below_->at(cos_theta), above_->at(cos_theta), part_);
}

glm::vec3 LossTables::At::at(const glm::vec3& w) const {
    return glm::mix(below_->at(w), above_->at(w), part_);
}

glm::vec3 LossTables::At::average() const {
    return glm::mix(below_->average(), above_->average(), part_);
}

}  // namespace phasetree::tracer
