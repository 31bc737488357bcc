// Parameters that several kinds of materials in scene files have in common.
#pragma once

#include <optional>

#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"
#include "scene/parameter_types.hpp"
#include "shading/material.hpp"
#include "shading/thin_film.hpp"

namespace phasetree::tracer {

inline constexpr Parameter roughness_parameter{
    "roughness", "", "Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt.", limits::fraction, true};

// Thin-film parameters of clear, conducting and coated materials.
struct FilmParameters {
    std::optional<Number> film_thickness{};
    float film_ior = SurfaceFilm{}.ior;

    template <class P, class V>
    static void film_parameters(V&& v) {
        v(&P::film_thickness,
          Parameter{"film_thickness", "nm",
                    "Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by "
                    "default there is none. Where two clear materials with films meet, the thicker one is used.",
                    Limits{.low = 0, .high = ThinFilm::thickest}, true});
        v(&P::film_ior, Parameter{"film_ior", "", "Refractive index of the film.", Limits{.low = 1, .high = 4}, true});
    }
    std::optional<SurfaceFilm> film() const {
        if (!film_thickness) return std::nullopt;
        return SurfaceFilm{*film_thickness, film_ior};
    }
};

// Parameters that bump the surface normals of a material.
struct BumpParameters {
    std::optional<Texture> bump_texture{};
    std::optional<float> bump_height{};

    template <class P, class V>
    static void bump_parameters(V&& v) {
        v(&P::bump_texture, Parameter{"bump", "",
                                      "Bump map: a texture whose bright parts look raised. It changes the normals "
                                      "only, not the surface. A discontinuity of the texture counts as a slope "
                                      "of 45° to 55°. Where two clear materials with bumps meet, the higher one is "
                                      "used.",
                                      limits::any, true});
        v(&P::bump_height,
          Parameter{"bump_height", "m", "With a bump map: height of white above black; may be negative.",
                    Limits{.low = -farthest, .high = farthest}, true});
    }
    /// Throws ParameterError if only one of the two is given.
    std::optional<Bump> bump() const;
};

// Parameters of materials that meshes may have, too, which perturb the surface normals.
struct PerturbationParameters : BumpParameters {
    std::optional<NormalMap> normal_map{};

    template <class P, class V>
    static void perturbation_parameters(V&& v) {
        bump_parameters<P>(v);
        v(&P::normal_map,
          Parameter{"normal_map", "", "Instead of a bump map: a normal map, on a mesh that has texture coordinates.",
                    limits::any, true});
    }
    /// Throws ParameterError for inconsistent parameters.
    std::optional<NormalPerturbation> perturbation() const;
};

}  // namespace phasetree::tracer
