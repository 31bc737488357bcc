// What is constant over a principled surface (bsdf/principled.hpp), and its BSDF at a point. Names and meanings of the
// numbers are those of OpenPBR Surface 1.1: a roughness is the square root of GGX's α.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "shading/bsdf/principled.hpp"
#include "shading/shared_surfaces.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// The parameters at a point. Colours are in the components of the light, or red, green and blue.
struct PrincipledPoint {
    float base_weight = 1.0f;
    glm::vec3 base_color{0.8f};
    float diffuse_roughness = 0.0f;
    float metalness = 0.0f;
    float specular_weight = 1.0f;
    glm::vec3 specular_color{1.0f};
    float roughness = 0.3f;  ///< across the grain, if there is one
    float coat_weight = 0.0f;
    glm::vec3 coat_color{1.0f};
    float coat_roughness = 0.0f;
    float coat_darkening = 1.0f;
    float fuzz_weight = 0.0f;
    glm::vec3 fuzz_color{1.0f};
    float fuzz_roughness = 0.5f;
    float film_weight = 0.0f;
    float film_thickness = 500.0f;  ///< in nanometres
};

/// The ranges of the parameters that need tables, and those that are the same everywhere.
struct PrincipledRanges {
    float outside = 1.0f;  ///< index of the clear medium in front
    float ior = 1.5f;
    float coat_ior = 1.6f;
    float aspect = 1.0f;  ///< of the grain
    ValueRange diffuse_roughness{}, metalness{}, roughness{0.3f, 0.3f};
    ValueRange coat_weight{}, coat_roughness{}, fuzz_weight{}, fuzz_roughness{0.5f, 0.5f};
    std::optional<FilmOfSurface> film{};
};

class PrincipledSurface {
  public:
    PrincipledSurface(const PrincipledRanges& ranges, SharedSurfaces& shared);

    /// The parameters must be in the ranges. The BSDF refers to this surface and to the wavelengths.
    PrincipledBsdf at(const PrincipledPoint& point, const Wavelengths* wavelengths = nullptr) const;

  private:
    /// The base, bare or below the coat.
    struct Base {
        float outside;  ///< index of what is on it
        std::shared_ptr<const DielectricLayer> gloss;
        std::shared_ptr<const ConductorSurface> metal;  ///< null if there is no metal
    };
    Base base_of(float outside, const ValueRange& alpha, SharedSurfaces& shared) const;
    PrincipledBase at(const Base& base, float alpha, const PrincipledPoint& point,
                      const Wavelengths* wavelengths) const;

    PrincipledRanges ranges_;
    std::optional<Base> bare_, coated_;
    std::shared_ptr<const DielectricLayer> coat_;
    std::shared_ptr<const LossTables> fuzz_;
    std::shared_ptr<const FilmColours> film_colours_;  ///< of metal
};

}  // namespace phasetree::tracer
