// Compensation of multiple scattering. Microfacet models account for one scattering only, so a rough surface loses the
// light that would be scattered again. This file tabulates that loss and provides the lobe that restores it.
//
//   1 − E(ω)    the part of the light along ω that single scattering loses because it would meet the surface again. It
//               depends on μ = cos θ and, if the surface has a grain along x, on |sin φ|
//   L̄           1/π ∫ (1 − E(ω)) μ dω, the same under uniform light
//
// Light that has been scattered several times has lost its direction, so it is restored by f = c (1 − E(o)) (1 − E(i))
// / (π L̄). This is reciprocal, and its albedo is exactly c (1 − E(o)) of the table because L̄ is computed from the
// same table: with c = 1, a lossless surface reflects all light, up to the error of E in the table. E is integrated
// numerically over the same microfacets that are sampled. The lobe is sampled with a pdf proportional to s(μ) μ, where
// s is constant between two nodes of μ: the mean of 1 − E there, over all φ and the colour channels.
//
// References: Kelemen & Szirmay-Kalos, A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001 (the
// lobe); Kulla & Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH course 2017 (its use for lost
// energy).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shading/bsdf/film_of_surface.hpp"

namespace phasetree::tracer {

/// A table of 1 − E(ω) for one roughness and each colour channel.
class LossTable {
  public:
    /// Makes the table of a surface without a grain; the function returns E(μ).
    explicit LossTable(const std::function<glm::vec3(float)>& directional_albedo);
    /// Makes the table of a surface with a grain along x; the function returns E(μ, |sin φ|).
    explicit LossTable(const std::function<glm::vec3(float, float)>& directional_albedo);

    /// The first overload requires a surface without a grain.
    glm::vec3 at(float cos_theta) const;
    glm::vec3 at(const glm::vec3& w) const;
    const glm::vec3& average() const { return average_; }

    /// Samples a direction with z > 0 of the lobe; pdf() is its pdf.
    glm::vec3 sample(const glm::vec2& u) const;
    float pdf(float cos_theta) const;

  private:
    static constexpr std::size_t nodes = 128;    ///< at μ = (i / (nodes − 1))², dense where E is steep
    static constexpr std::size_t azimuths = 49;  ///< at |sin φ| = (i / (azimuths − 1))², of a surface with a grain

    using Row = std::array<glm::vec3, nodes>;
    static glm::vec3 at(const Row& row, float cos_theta);
    /// `mean` is the mean of the rows over all φ.
    LossTable(std::vector<Row> rows, const Row& mean);

    std::vector<Row> rows_;  ///< one for each |sin φ|, or one alone
    glm::vec3 average_{0.0f};
    std::array<float, nodes - 1> density_;  ///< of the lobe between two nodes, over that of Lambert's law
    std::array<float, nodes> cumulative_;
};

/// 1 − E(μ) over a range of roughness, or for one roughness if the range is empty.
class LossTables {
  public:
    /// `table` returns the table of a roughness; it is called concurrently.
    LossTables(const ValueRange& roughness, const std::function<LossTable(float)>& table);

    /// The losses at one roughness, interpolated between the two nearest tables. Directions are sampled from the nearer
    /// one.
    class At {
      public:
        At(const LossTable& below, const LossTable& above, float part) : below_(&below), above_(&above), part_(part) {}

        glm::vec3 at(float cos_theta) const;
        glm::vec3 at(const glm::vec3& w) const;
        glm::vec3 average() const;
        glm::vec3 sample(const glm::vec2& u) const { return nearest().sample(u); }
        float pdf(float cos_theta) const { return nearest().pdf(cos_theta); }

      private:
        const LossTable& nearest() const { return part_ < 0.5f ? *below_ : *above_; }

        const LossTable* below_;
        const LossTable* above_;
        float part_;
    };
    At at(float roughness) const;

  private:
    RoughnessNodes nodes_;
    std::vector<LossTable> tables_;
};

}  // namespace phasetree::tracer
