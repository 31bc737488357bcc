// Integrals over a rough diffuse base (rough_diffuse.hpp) below a layer that lets the part T(μ) of the light in.
//
//   H(μₒ) = 1/π ∫ T(μ) (s/t) μ dω = 2/π sin θₒ ∫₀¹ T(μ) (1/max(μₒ, μ) − 1) μ sin θ dμ
//
// H follows from s = sin θₒ sin θ cos φ, whose positive half is divided by t = max(μₒ, μ), by integration over φ. If T
// depends on the azimuth, its mean is used.
#pragma once

#include <array>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shading/bsdf/film_of_surface.hpp"
#include "shading/bsdf/lost_energy.hpp"

namespace phasetree::tracer {

class RoughDiffuseTable {
  public:
    struct Row {
        glm::vec3 entering;    ///< T, averaged over the azimuth
        glm::vec3 oren_nayar;  ///< H

        Row mixed(const Row& other, float part) const {
            return {glm::mix(entering, other.entering, part), glm::mix(oren_nayar, other.oren_nayar, part)};
        }
    };

    explicit RoughDiffuseTable(const LossTables::At& entering);

    Row at(float mu) const;
    /// The row of T = 1.
    static Row of_white(float mu);

  private:
    static constexpr std::size_t nodes = 64;  ///< at μ = (i / (nodes − 1))²

    std::array<Row, nodes> rows_;
};

/// The tables of a range of roughness of the layer.
class RoughDiffuseTables {
  public:
    RoughDiffuseTables(const ValueRange& roughness, const LossTables& entering);

    RoughDiffuseTable::Row at(float roughness, float mu) const;

  private:
    RoughnessNodes nodes_;
    std::vector<RoughDiffuseTable> tables_;
};

}  // namespace phasetree::tracer
