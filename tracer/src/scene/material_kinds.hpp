// The kinds of materials in scene files: one list, which drives the reader, the reference and the schema. made()
// returns the material.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "lights/grouped.hpp"
#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"
#include "scene/parameter_types.hpp"
#include "scene/voxels.hpp"
#include "shading/material.hpp"
#include "shading/thin_film.hpp"

namespace phasetree::tracer {

inline constexpr Parameter roughness_parameter{"roughness", "", "α of GGX: 0 is polished, 0.1 satin, 0.5 matt.",
                                               limits::fraction, true};

std::vector<std::string_view> names_of_media();
std::vector<std::string_view> names_of_glasses();

// Thin-film parameters of clear, conducting and coated materials.
struct FilmParameters {
    std::optional<Number> film_thickness{};
    float film_ior = SurfaceFilm{}.ior;

    template <class P, class V>
    static void film_parameters(V&& v) {
        v(&P::film_thickness,
          Parameter{"film_thickness", "nm",
                    "Thickness of a film on the surface, which shows colours as soap and oil do; there is none without "
                    "it. Where two clear materials have one, the thicker counts.",
                    Limits{.low = 0, .high = ThinFilm::thickest}, true});
        v(&P::film_ior, Parameter{"film_ior", "", "Refractive index of the film.", Limits{.low = 1, .high = 4}, true});
    }
    std::optional<SurfaceFilm> film() const {
        if (!film_thickness) return std::nullopt;
        return SurfaceFilm{*film_thickness, film_ior};
    }
};

// Parameters of opaque materials that perturb the surface normals.
struct PerturbationParameters {
    std::optional<Texture> bump_texture{};
    std::optional<float> bump_height{};
    std::optional<NormalMap> normal_map{};

    template <class P, class V>
    static void perturbation_parameters(V&& v) {
        v(&P::bump_texture,
          Parameter{"bump", "",
                    "A texture whose bright places look as if they stood out of the surface: it turns the surface's "
                    "normals and moves nothing. A step in it is a slope of 45° to 55°.",
                    limits::any, true});
        v(&P::bump_height,
          Parameter{"bump_height", "m", "With a bump: how much higher white is than black; lower, if it is negative.",
                    Limits{.low = -farthest, .high = farthest}, true});
        v(&P::normal_map,
          Parameter{"normal_map", "", "Instead of a bump: an image of normals, on a mesh that has texture coordinates.",
                    limits::any, true});
    }
    /// Throws ParameterError for inconsistent parameters.
    std::optional<NormalPerturbation> perturbation() const;
};

struct ClearParameters : FilmParameters {
    static constexpr KindInfo info{"clear",
                                   "Vacuum, air, water, glass, milk, wax, fog: light travels inside, and may be "
                                   "absorbed and scattered there.",
                                   "exp(−(a + s) d)"};

    std::optional<float> ior{};
    std::optional<std::string> glass{};
    std::optional<float> abbe_number{};
    std::optional<glm::vec3> absorption{};
    std::optional<glm::vec3> color{};
    float color_distance = 1.0f;
    Number roughness = 0.0f;
    std::optional<glm::vec3> scattering{};
    std::optional<glm::vec3> albedo{};
    std::optional<glm::vec3> mean_free_path{};
    std::optional<std::string> medium{};
    std::optional<float> scale{};
    std::optional<float> anisotropy{};
    std::optional<glm::vec3> emission{};
    SharedSpectrum absorption_spectrum{};
    SharedLightSpectrum emission_spectrum{};
    std::optional<Field> density{};
    std::optional<float> density_depth{};
    std::optional<Voxels> density_grid{};
    std::optional<Voxels> temperature_grid{};
    float emission_temperature = 2000.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = ClearParameters;
        v(&P::ior, Parameter{"ior", "", "Refractive index against vacuum; needed unless a glass is named.",
                             Limits{.low = 0.1f, .high = 10}, true});
        v(&P::glass, ChoiceParameter{{"glass", "",
                                      "Instead of the index: a measured substance whose index changes with the "
                                      "wavelength, so that white light is split into its colours.",
                                      limits::any, true},
                                     names_of_glasses});
        v(&P::abbe_number, Parameter{"abbe_number", "",
                                     "Abbe's number of a glass of one's own, which splits white light the more the "
                                     "smaller it is: crown glass has 60, flint glass 30. Without it the index is that "
                                     "of all colours.",
                                     Limits{.low = 10, .high = 1000}, true});
        v(&P::absorption,
          RgbParameter{{"absorption", "1/m", "Absorption of red, green and blue, a; nothing is absorbed without it.",
                        limits::non_negative, true}});
        v(&P::absorption_spectrum,
          SpectrumParameter{{"absorption_spectrum", "nm, 1/m",
                             "Instead of the absorption: wavelengths and the absorption at each. Without "
                             "\"spectral\" red, green and blue are absorbed so that a layer looks the same that lets "
                             "a third of white light through, or more.",
                             limits::non_negative, true}});
        v(&P::color,
          ColourParameter{{"color", "", "Instead of the absorption: what is left of white light after a distance.",
                           Limits{.low = 0, .high = 1, .low_open = true}, true}});
        v(&P::color_distance,
          Parameter{"color_distance", "m", "The distance after which the colour is left.", limits::positive, true});
        v(&P::roughness, roughness_parameter);
        v(&P::scattering,
          RgbParameter{{"scattering", "1/m", "Scattering of red, green and blue, s; nothing is scattered without it.",
                        limits::non_negative, true}});
        v(&P::albedo, RgbParameter{{"albedo", "",
                                    "Instead of absorption and scattering: the part of the light that is scattered "
                                    "where it meets the medium, s/(a + s).",
                                    limits::fraction, true}});
        v(&P::mean_free_path,
          RgbParameter{{"mean_free_path", "m", "With the albedo: how far light goes on average, 1/(a + s).",
                        limits::positive, true}});
        v(&P::medium, ChoiceParameter{{"medium", "",
                                       "Instead of absorption and scattering: a measured medium (Jensen et al. 2001).",
                                       limits::any, true},
                                      names_of_media});
        v(&P::scale, Parameter{"scale", "mm", "With a measured medium: how long the scene's unit of length is.",
                               limits::positive, true});
        v(&P::anisotropy, Parameter{"anisotropy", "",
                                    "The mean cosine g of Henyey and Greenstein's phase function: positive goes on "
                                    "forwards. Measured media scatter as much more as makes their reduced scattering, "
                                    "(1 − g) s, what was measured. 0 without it.",
                                    Limits{.low = -0.99f, .high = 0.99f}, true});
        v(&P::emission, RgbParameter{{"emission", "1/m",
                                      "Radiance that the medium itself adds along a ray. It needs absorption or "
                                      "scattering in the same channels.",
                                      limits::non_negative, true}});
        v(&P::emission_spectrum,
          Parameter{"emission_spectrum", "",
                    "How the emission is spread over the wavelengths, as \"spectrum\" of lights. Of the emission only "
                    "the brightness counts then.",
                    limits::any, true});
        v(&P::density,
          Parameter{"density", "",
                    "A field that tells where the medium is: the density is 0 at its surface and outside, and rises "
                    "evenly to 1 inside. Absorption, scattering and emission are multiplied by it.",
                    limits::any, true});
        v(&P::density_depth,
          Parameter{"density_depth", "m", "With a density: how deep inside of the field it becomes 1.",
                    limits::positive, true});
        v(&P::density_grid, Parameter{"density_grid", "",
                                      "Instead of a density: numbers at voxels, by which absorption, scattering and "
                                      "emission are multiplied.",
                                      limits::any, true});
        v(&P::temperature_grid,
          Parameter{
              "temperature_grid", "K",
              "Temperatures at voxels, by which the medium shines as what is hot does, in proportion to its "
              "density. It needs an emission, of which only the brightness counts then, and a density. The grid's "
              "\"factor\" makes kelvin of its numbers.",
              limits::any, true});
        v(&P::emission_temperature,
          Parameter{"emission_temperature", "K",
                    "With a grid of temperatures: the one at which the medium emits the emission. What is hotter emits "
                    "more.",
                    Limits{.low = 500, .high = 100000}, true});
        film_parameters<P>(v);
    }
    Medium interior() const;
    std::optional<Dispersion> dispersion() const;
    Clear made() const;
};

struct DiffuseParameters : PerturbationParameters {
    static constexpr KindInfo info{"diffuse", "Paper, plaster, clay: reflects alike in all directions."};

    Texture color{};
    Number roughness = 0.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = DiffuseParameters;
        v(&P::color, Parameter{"color", "", "Reflectance.", limits::any});
        v(&P::roughness,
          Parameter{"roughness", "",
                    "How rough it is: 0 is Lambert's law, 1 clay or the moon, whose rim is as bright as its middle.",
                    limits::fraction, true});
        perturbation_parameters<P>(v);
    }
    Diffuse made() const { return {color, roughness, perturbation()}; }
};

std::vector<std::string_view> names_of_metals();

// Grain parameters of brushed metal.
struct GrainParameters {
    std::optional<glm::vec3> grain_along{};
    std::optional<glm::vec3> grain_around{};
    std::optional<glm::vec3> grain_through{};
    std::optional<float> grain_aspect{};

    template <class P, class V>
    static void grain_parameters(V&& v) {
        v(&P::grain_along, DirectionParameter{{"grain_along", "",
                                               "Brushed metal: the direction of its strokes, in the object's own "
                                               "space, or the scene's, of a mesh; moves within a tree do not turn it. "
                                               "It is projected onto the surface; where the surface is perpendicular "
                                               "to it strokes run any way. The roughness, which must not be 0, is that "
                                               "across them.",
                                               limits::any, true}});
        v(&P::grain_around, DirectionParameter{{"grain_around", "",
                                                "Instead of it, of metal that was turned on a lathe: the direction of "
                                                "the axis around which the strokes run.",
                                                limits::any, true}});
        v(&P::grain_through, Parameter{"grain_through", "m",
                                       "With an axis: a point of it, in the object's own space, or the scene's, if it "
                                       "is a mesh; the origin without it.",
                                       Limits{.low = -farthest, .high = farthest}, true});
        v(&P::grain_aspect,
          Parameter{"grain_aspect", "", "With a grain: the roughness along the strokes over that across; 0.2 without.",
                    Limits{.low = 0.1f, .high = 1}, true});
    }
    /// `roughness` is that of the metal. Throws ParameterError for inconsistent parameters.
    std::optional<Grain> grain(const Number& roughness) const;
};

struct ConductorParameters : FilmParameters, PerturbationParameters, GrainParameters {
    static constexpr KindInfo info{"conductor",
                                   "Metal: one of the measured ones, with a complex index η + ik of one's own, or of a "
                                   "reflectance, which may be a texture."};

    std::optional<std::string> metal{};
    std::optional<glm::vec3> eta{};
    std::optional<glm::vec3> k{};
    std::optional<Texture> reflectance{};
    Number roughness = 0.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = ConductorParameters;
        v(&P::metal, ChoiceParameter{{"metal", "", "A measured metal.", limits::any, true}, names_of_metals});
        v(&P::eta,
          RgbParameter{{"eta", "", "η for red, green and blue, instead of a measured metal.", limits::positive, true}});
        v(&P::k, RgbParameter{{"k", "", "k for red, green and blue; needed with η.", limits::non_negative, true}});
        v(&P::reflectance, Parameter{"reflectance", "",
                                     "Instead of both: the colour of light that falls on it at a right angle and is "
                                     "reflected; more is at others. Such a metal has no film.",
                                     limits::any, true});
        v(&P::roughness, roughness_parameter);
        grain_parameters<P>(v);
        film_parameters<P>(v);
        perturbation_parameters<P>(v);
    }
    Conductor made() const;
};

struct CoatedParameters : FilmParameters, PerturbationParameters {
    static constexpr KindInfo info{"coated", "Varnished or glazed: a clear coat over a diffuse base."};

    Texture color{};
    float ior = Coated{}.ior;
    Number roughness = 0.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = CoatedParameters;
        v(&P::color, Parameter{"color", "", "Reflectance of the base.", limits::any});
        v(&P::ior, Parameter{"ior", "", "Refractive index of the coat.", Limits{.low = 1, .high = 4}, true});
        v(&P::roughness, roughness_parameter);
        film_parameters<P>(v);
        perturbation_parameters<P>(v);
    }
    Coated made() const { return {color, ior, roughness, film(), perturbation()}; }
};

struct GlowingParameters {
    static constexpr KindInfo info{"glowing", "Embers, lava, a filament, a screen: shines alike in all directions."};

    Texture light = Glowing{}.light;
    float radiance = Glowing{}.radiance;
    Texture color = Glowing{}.color;
    SharedLightSpectrum spectrum{};
    std::string group{default_group};

    template <class V>
    static void parameters(V&& v) {
        using P = GlowingParameters;
        v(&P::light, Parameter{"light", "", "Colour of its light; white without it.", limits::any, true});
        v(&P::radiance, Parameter{"radiance", "",
                                  "Radiance of its surface where the colour of its light is 1; n² times that against a "
                                  "material of index n.",
                                  Limits{.low = 0, .high = 1e12f, .low_open = true}, true});
        v(&P::color, Parameter{"color", "", "Reflectance; black without it.", limits::any, true});
        v(&P::spectrum, spectrum_parameter);
        v(&P::group, group_parameter);
    }
    Glowing made() const { return {light, radiance, color, spectrum, checked_group(group)}; }
};

struct MixParameters {
    static constexpr KindInfo info{"mix",
                                   "One of two materials at each place: iron and rust, paint and the metal under it. "
                                   "Neither is clear or glowing."};

    Material first{};
    Material second{};
    Number amount = 0.5f;

    template <class V>
    static void parameters(V&& v) {
        using P = MixParameters;
        v(&P::first, Parameter{"first", "", "The one where the amount is 0."});
        v(&P::second, Parameter{"second", "", "The one where the amount is 1."});
        v(&P::amount,
          Parameter{"amount", "", "How much of the second; between 0 and 1 both are there, as finely mixed as can be.",
                    limits::fraction, true});
    }
    Mix made() const;
};

using MaterialKinds = TypeList<ClearParameters, DiffuseParameters, ConductorParameters, CoatedParameters,
                               GlowingParameters, MixParameters>;

// A material missing from the list fails to compile here.
template <class... Kinds, class... Materials>
constexpr bool make_all_of(TypeList<Kinds...>, const std::variant<Materials...>*) {
    constexpr auto is_made = []<class M>(const M*) {
        return (std::is_same_v<M, decltype(std::declval<Kinds>().made())> || ...);
    };
    return (is_made(static_cast<const Materials*>(nullptr)) && ...);
}
static_assert(make_all_of(MaterialKinds(), static_cast<Material*>(nullptr)), "every material has a kind in the list");

// The name of a material's kind in scene files.
template <class... Kinds>
std::string_view kind_name(const Material& material, TypeList<Kinds...>) {
    return std::visit(
        []<class M>(const M&) {
            std::string_view name;
            (void)((std::is_same_v<M, decltype(std::declval<Kinds>().made())> && !(name = Kinds::info.name).empty()) ||
                   ...);
            return name;
        },
        material);
}
inline std::string_view kind_name(const Material& material) {
    return kind_name(material, MaterialKinds());
}

}  // namespace phasetree::tracer
