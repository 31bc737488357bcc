// What a rough surface loses because its microfacets are followed for one scattering only, and the lobe that gives it
// back.
//
//   1 − E(ω)    the part of the light along ω that single scattering loses: it would meet the surface again. It depends
//               on μ = cos θ and, where the surface has a grain along x, on |sin φ|
//   L̄           1/π ∫ (1 − E(ω)) μ dω, the same under uniform light
//
// Light that has been scattered several times has forgotten where it came from, so it is given back by
// f = c (1 − E(o)) (1 − E(i)) / (π L̄), which is reciprocal, and whose albedo is c (1 − E(o)): with c = 1 a lossless
// surface reflects all light, whatever the table's own error. E is integrated numerically from the very microfacets
// that are sampled. Its lobe is sampled in proportion to the mean of (1 − E) μ between two nodes of μ and over all φ.
//
// References: Kelemen & Szirmay-Kalos, A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001 (the
// lobe); Kulla & Conty, Revisiting Physically Based Shading at Imageworks, SIGGRAPH course 2017 (it as lost energy).
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shading/bsdf/film_of_surface.hpp"

namespace phasetree::tracer {

/// 1 − E(ω) of one roughness, of each colour channel.
class LossTable {
  public:
    /// Of a surface without a grain, whose single scattering gives back E(μ).
    explicit LossTable(const std::function<glm::vec3(float)>& directional_albedo);
    /// Of one with a grain along x, whose single scattering gives back E(μ, |sin φ|).
    explicit LossTable(const std::function<glm::vec3(float, float)>& directional_albedo);

    /// Of a surface without a grain.
    glm::vec3 at(float cos_theta) const;
    glm::vec3 at(const glm::vec3& w) const;
    const glm::vec3& average() const { return average_; }

    /// A direction with z > 0 of the lobe, and its density.
    glm::vec3 sample(const glm::vec2& u) const;
    float pdf(float cos_theta) const;

  private:
    static constexpr std::size_t nodes = 128;    ///< at μ = (i / (nodes − 1))², dense where E is steep
    static constexpr std::size_t azimuths = 49;  ///< at |sin φ| = (i / (azimuths − 1))², of a surface with a grain

    using Row = std::array<glm::vec3, nodes>;
    static glm::vec3 at(const Row& row, float cos_theta);
    /// Made of all rows and of their mean over all φ.
    LossTable(std::vector<Row> rows, const Row& mean);

    std::vector<Row> rows_;  ///< one for each |sin φ|, or one alone
    glm::vec3 average_{0.0f};
    std::array<float, nodes - 1> density_;  ///< of the lobe between two nodes, over that of Lambert's law
    std::array<float, nodes> cumulative_;
};

/// 1 − E(μ) over a range of roughness; of one roughness alone, if the range is empty.
class LossTables {
  public:
    /// `table` gives the table of a roughness, of several at once on other threads.
    LossTables(const ValueRange& roughness, const std::function<LossTable(float)>& table);

    /// What a point of the surface has of it, interpolated between the tables of the neighbouring roughnesses.
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
