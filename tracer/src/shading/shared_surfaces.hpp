// A cache of surfaces and their tables, shared by equal interfaces.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shading/bsdf/coating_albedo.hpp"
#include "shading/bsdf/conductor_surface.hpp"
#include "shading/bsdf/dielectric_layer.hpp"
#include "shading/bsdf/dielectric_surface.hpp"
#include "shading/bsdf/fuzz.hpp"
#include "shading/film_colours.hpp"

namespace phasetree::tracer {

/// Used by one thread while a scene's interfaces are made. It may be kept between scenes that differ little.
class SharedSurfaces {
  public:
    /// Call this between scenes. Discards surfaces that are no longer in use elsewhere. A scene's surfaces have the
    /// same bits whatever scenes came before.
    void begin_scene();
    std::shared_ptr<const DielectricSurface> dielectric(float ior_from, float ior_to,
                                                        const std::optional<ValueRange>& roughness,
                                                        const std::optional<FilmOfSurface>& film);
    std::shared_ptr<const ConductorSurface> conductor(float ior, const glm::vec3& eta, const glm::vec3& k,
                                                      const std::optional<ValueRange>& roughness,
                                                      const std::optional<FilmOfSurface>& film,
                                                      std::span<const MetalPoint> spectrum, float aspect = 1.0f);
    std::shared_ptr<const ConductorSurface> metal_of_reflectance(float ior, const std::optional<ValueRange>& roughness,
                                                                 float aspect = 1.0f);
    std::shared_ptr<const CoatingAlbedo> coating(float ior_from, float ior_coat, const ValueRange& roughness,
                                                 const std::optional<FilmOfSurface>& film);
    std::shared_ptr<const DielectricLayer> layer(const DielectricLayer::Kind& kind);
    /// The losses of lossless microfacets with a range of α; null without one.
    std::shared_ptr<const LossTables> losses(const std::optional<ValueRange>& roughness, float aspect = 1.0f);
    /// The losses of fuzz with a range of α.
    std::shared_ptr<const LossTables> fuzz(const ValueRange& alpha);
    std::shared_ptr<const FilmColours> film_colours();

  private:
    // What a surface is made from. `ior_from` is that of the side from which it is seen.
    struct Dielectric {
        float ior_from, ior_to;
        std::optional<ValueRange> roughness;
        std::optional<FilmOfSurface> film;
        bool operator==(const Dielectric&) const = default;
    };
    struct Conductor {
        float ior_from;
        glm::vec3 eta, k;
        std::optional<ValueRange> roughness;
        std::optional<FilmOfSurface> film;
        const MetalPoint* spectrum;
        float aspect;
        bool operator==(const Conductor&) const = default;
    };
    struct MetalOfReflectance {
        float ior_from;
        std::optional<ValueRange> roughness;
        float aspect;
        bool operator==(const MetalOfReflectance&) const = default;
    };
    struct Coating {
        float ior_from, ior_coat;
        ValueRange roughness;
        std::optional<FilmOfSurface> film;
        bool operator==(const Coating&) const = default;
    };
    template <class Key, class Surface>
    using Made = std::vector<std::pair<Key, std::shared_ptr<const Surface>>>;

    struct MetalLosses {
        ValueRange roughness;
        float aspect;
        bool operator==(const MetalLosses&) const = default;
    };

    // The dielectrics of this scene. The side of an interface that is requested first is computed, and the other one is
    // made by reversing it, so the order decides their last bits.
    Made<Dielectric, DielectricSurface> dielectrics_;
    Made<Dielectric, DielectricSurface> computed_dielectrics_;  // of earlier scenes too; none is reversed
    Made<Conductor, ConductorSurface> conductors_;
    Made<MetalOfReflectance, ConductorSurface> metals_of_reflectance_;
    Made<MetalLosses, LossTables> metal_losses_;
    Made<Coating, CoatingAlbedo> coatings_;
    Made<DielectricLayer::Kind, DielectricLayer> layers_;
    Made<ValueRange, LossTables> fuzz_losses_;
    std::shared_ptr<const FilmColours> film_colours_;
    ThinFilms films_;
};

}  // namespace phasetree::tracer
