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
#include "scene/surface_parameters.hpp"
#include "scene/thin_kinds.hpp"
#include "scene/voxels.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

std::vector<std::string_view> names_of_media();
std::vector<std::string_view> names_of_glasses();

struct ClearParameters : FilmParameters, BumpParameters {
    static constexpr KindInfo info{
        "clear",
        "Vacuum, air, water, glass, milk, wax, fog: light travels inside, where it may be absorbed and scattered.",
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
    std::optional<PhaseFunction> phase_function{};
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
        v(&P::ior, Parameter{"ior", "", "Refractive index relative to vacuum; required unless a glass is named.",
                             Limits{.low = 0.1f, .high = 10}, true});
        v(&P::glass, ChoiceParameter{{"glass", "",
                                      "Instead of the index: a measured substance whose index depends on the "
                                      "wavelength, which causes dispersion.",
                                      limits::any, true},
                                     names_of_glasses});
        v(&P::abbe_number, Parameter{"abbe_number", "",
                                     "Abbe number; the smaller, the stronger the dispersion: crown glass has 60, flint "
                                     "glass 30. Without it, the index is the same for all colours.",
                                     Limits{.low = 10, .high = 1000}, true});
        v(&P::absorption,
          RgbParameter{{"absorption", "1/m", "Absorption coefficients a of red, green and blue; 0 by default.",
                        limits::non_negative, true}});
        v(&P::absorption_spectrum,
          SpectrumParameter{{"absorption_spectrum", "nm, 1/m",
                             "Instead of the absorption: wavelengths and the absorption coefficient at each. Unless "
                             "the scene is \"spectral\", it is converted to red, green and blue. Layers that transmit "
                             "at least a third of white light keep their colour; thicker ones may differ.",
                             limits::non_negative, true}});
        v(&P::color,
          ColourParameter{{"color", "", "Instead of the absorption: the colour of white light after a distance.",
                           Limits{.low = 0, .high = 1, .low_open = true}, true}});
        v(&P::color_distance, Parameter{"color_distance", "m", "The distance after which white light has this colour.",
                                        limits::positive, true});
        v(&P::roughness, roughness_parameter);
        v(&P::scattering,
          RgbParameter{{"scattering", "1/m", "Scattering coefficients s of red, green and blue; 0 by default.",
                        limits::non_negative, true}});
        v(&P::albedo,
          RgbParameter{{"albedo", "", "Instead of absorption and scattering: the single-scattering albedo, s/(a + s).",
                        limits::fraction, true}});
        v(&P::mean_free_path, RgbParameter{{"mean_free_path", "m", "With the albedo: the mean free path, 1/(a + s).",
                                            limits::positive, true}});
        v(&P::medium, ChoiceParameter{{"medium", "",
                                       "Instead of absorption and scattering: a measured medium (Jensen et al. 2001).",
                                       limits::any, true},
                                      names_of_media});
        v(&P::scale, Parameter{"scale", "mm", "With a measured medium: how many millimetres one scene unit is.",
                               limits::positive, true});
        v(&P::anisotropy,
          Parameter{"anisotropy", "",
                    "Mean cosine g of the Henyey-Greenstein phase function; positive values scatter forwards. Measured "
                    "media keep their reduced scattering, (1 − g) s, for any g. Default 0.",
                    Limits{.low = -0.99f, .high = 0.99f}, true});
        v(&P::phase_function,
          Parameter{"phase_function", "",
                    "Directions into which the medium scatters light, if not those of \"anisotropy\".", limits::any,
                    true});
        v(&P::emission, RgbParameter{{"emission", "1/m",
                                      "Radiance emitted per unit of length along a ray. Requires absorption or "
                                      "scattering in the same channels.",
                                      limits::non_negative, true}});
        v(&P::emission_spectrum, Parameter{"emission_spectrum", "",
                                           "Spectrum of the emission, as \"spectrum\" of lights. With it, only the "
                                           "brightness of the emission is used.",
                                           limits::any, true});
        v(&P::density, Parameter{"density", "",
                                 "Density as a field: 0 at its surface and outside, rising linearly to 1 inside. "
                                 "Absorption, scattering and emission are multiplied by the density.",
                                 limits::any, true});
        v(&P::density_depth,
          Parameter{"density_depth", "m", "With a density: the depth inside the field at which it reaches 1.",
                    limits::positive, true});
        v(&P::density_grid,
          Parameter{"density_grid", "",
                    "Instead of a density: a voxel grid by which absorption, scattering and emission are multiplied.",
                    limits::any, true});
        v(&P::temperature_grid,
          Parameter{"temperature_grid", "K",
                    "Voxel grid of temperatures: the medium emits as a black body, in proportion to its density. "
                    "Requires a density and an emission, of which it uses only the brightness. The grid's "
                    "\"factor\" converts its numbers to kelvin.",
                    limits::any, true});
        v(&P::emission_temperature, Parameter{"emission_temperature", "K",
                                              "With a temperature grid: the temperature at which the medium has the "
                                              "given emission. Hotter parts emit more.",
                                              Limits{.low = 500, .high = 100000}, true});
        film_parameters<P>(v);
        bump_parameters<P>(v);
    }
    Medium interior() const;
    std::optional<Dispersion> dispersion() const;
    Clear made() const;
};

struct DiffuseParameters : PerturbationParameters {
    static constexpr KindInfo info{"diffuse", "Paper, plaster, clay: reflects equally in all directions."};

    Texture color{};
    Number roughness = 0.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = DiffuseParameters;
        v(&P::color, Parameter{"color", "", "Reflectance.", limits::any});
        v(&P::roughness,
          Parameter{"roughness", "",
                    "Roughness: 0 is Lambert's law, 1 is clay or the moon, whose limb is as bright as its centre.",
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
        v(&P::grain_along,
          DirectionParameter{
              {"grain_along", "",
               "Brushed metal: direction of the grain, in the space of the object, or of the scene for a mesh; "
               "transforms within a tree do not rotate it. It is projected onto the surface; where the surface is "
               "perpendicular to it, the grain is arbitrary. The roughness applies across the grain and must not be 0.",
               limits::any, true}});
        v(&P::grain_around, DirectionParameter{{"grain_around", "",
                                                "Instead of a direction, for metal turned on a lathe: direction of the "
                                                "axis around which the grain runs.",
                                                limits::any, true}});
        v(&P::grain_through, Parameter{"grain_through", "m",
                                       "With an axis: a point on it, in the space of the object, or of the scene for a "
                                       "mesh; by default the origin.",
                                       Limits{.low = -farthest, .high = farthest}, true});
        v(&P::grain_aspect,
          Parameter{"grain_aspect", "",
                    "With a grain: ratio of the roughness along the grain to that across it; default 0.2.",
                    Limits{.low = 0.1f, .high = 1}, true});
    }
    /// `roughness` is that of the surface, and `roughness_key` its name. Throws ParameterError for inconsistent
    /// parameters.
    std::optional<Grain> grain(const Number& roughness, std::string_view roughness_key = "roughness") const;
};

struct ConductorParameters : FilmParameters, PerturbationParameters, GrainParameters {
    static constexpr KindInfo info{"conductor",
                                   "Metal: a measured one, one with a given complex index η + ik, or one with a given "
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
        v(&P::k, RgbParameter{{"k", "", "k for red, green and blue; required with η.", limits::non_negative, true}});
        v(&P::reflectance, Parameter{"reflectance", "",
                                     "Instead of both: reflectance at normal incidence; it increases towards grazing "
                                     "angles. Such a metal cannot have a film.",
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

struct PrincipledParameters : FilmParameters, PerturbationParameters, GrainParameters {
    static constexpr KindInfo info{
        "principled",
        "Car paint, velvet, dusty plastic: layers with the parameters of OpenPBR Surface 1.1. The base is metal, or a "
        "gloss over a diffuse material; a coat and fuzz may cover it. Its roughness parameters are the square root of "
        "the α that other materials take. It is opaque; for transmission and subsurface scattering, use a phase of "
        "\"clear\"."};

    Number base_weight = Principled{}.base_weight;
    Texture base_color = Principled{}.color;
    Number base_diffuse_roughness = Principled{}.diffuse_roughness;
    Number base_metalness = Principled{}.metalness;
    Number specular_weight = Principled{}.specular_weight;
    Texture specular_color = Principled{}.specular_color;
    Number specular_roughness = Principled{}.roughness;
    float specular_ior = Principled{}.ior;
    Number coat_weight = Principled{}.coat_weight;
    Texture coat_color = Principled{}.coat_color;
    Number coat_roughness = Principled{}.coat_roughness;
    float coat_ior = Principled{}.coat_ior;
    Number coat_darkening = Principled{}.coat_darkening;
    Number fuzz_weight = Principled{}.fuzz_weight;
    Texture fuzz_color = Principled{}.fuzz_color;
    Number fuzz_roughness = Principled{}.fuzz_roughness;
    Number film_weight = Principled{}.film_weight;
    float emission_radiance = 0.0f;
    Texture emission_color = Glowing{}.light;
    SharedLightSpectrum emission_spectrum{};
    std::string group{default_group};

    template <class V>
    static void parameters(V&& v) {
        using P = PrincipledParameters;
        const auto fraction = [&](auto member, const char* name, const char* text) {
            v(member, Parameter{name, "", text, limits::fraction, true});
        };
        const auto color = [&](auto member, const char* name, const char* text) {
            v(member, Parameter{name, "", text, limits::any, true});
        };
        color(&P::base_color, "base_color",
              "Colour of the diffuse base as seen through the gloss, or reflectance of the metal at normal incidence; "
              "default 0.8.");
        fraction(&P::base_weight, "base_weight", "Multiplies the base colour.");
        fraction(&P::base_diffuse_roughness, "base_diffuse_roughness",
                 "Roughness of the diffuse base: 0 is Lambert's law, 1 is clay.");
        fraction(&P::base_metalness, "base_metalness", "0 is a gloss over a diffuse base, 1 is metal.");
        fraction(&P::specular_weight, "specular_weight", "Multiplies the reflectance of the gloss and of the metal.");
        color(&P::specular_color, "specular_color",
              "Tint of the gloss, and of the metal at 82° (\"F82-tint\"); default white.");
        fraction(&P::specular_roughness, "specular_roughness",
                 "Roughness of the gloss and of the metal; its square is the α of GGX. With a grain, it applies across "
                 "the grain.");
        v(&P::specular_ior,
          Parameter{"specular_ior", "", "Refractive index of the gloss.", Limits{.low = 1, .high = 4}, true});
        grain_parameters<P>(v);
        fraction(&P::coat_weight, "coat_weight", "Share of the surface that has a clear coat.");
        color(&P::coat_color, "coat_color",
              "Tint of light that crosses the coat twice at normal incidence; default white.");
        fraction(&P::coat_roughness, "coat_roughness", "Roughness of the coat.");
        v(&P::coat_ior, Parameter{"coat_ior", "", "Refractive index of the coat.", Limits{.low = 1, .high = 4}, true});
        fraction(&P::coat_darkening, "coat_darkening",
                 "How much the coat darkens the base by reflecting light back to it: 1 is physical, 0 keeps the base's "
                 "colour.");
        fraction(&P::fuzz_weight, "fuzz_weight", "Share of the surface that has fuzz: velvet, dust.");
        color(&P::fuzz_color, "fuzz_color", "Colour of the fuzz; default white.");
        fraction(&P::fuzz_roughness, "fuzz_roughness",
                 "Roughness of the fuzz: low for velvet, high for dust. Values below 0.26 are treated as 0.26.");
        film_parameters<P>(v);
        fraction(&P::film_weight, "film_weight", "With a film: share of the surface that has it.");
        v(&P::emission_radiance, Parameter{"emission_radiance", "",
                                           "Radiance, equal in all directions, where the emission colour is 1. Inside "
                                           "a material of index n, the radiance is n² times this value.",
                                           Limits{.low = 0, .high = 1e12f}, true});
        color(&P::emission_color, "emission_color", "Colour of the emitted light; default white.");
        v(&P::emission_spectrum, Parameter{"emission_spectrum", "",
                                           "Spectrum of the emission, as \"spectrum\" of lights. With it, only the "
                                           "brightness of the emission is used.",
                                           limits::any, true});
        v(&P::group, group_parameter);
        perturbation_parameters<P>(v);
    }
    Principled made() const;
};

struct GlowingParameters {
    static constexpr KindInfo info{"glowing", "Embers, lava, a filament, a screen: emits equally in all directions."};

    Texture light = Glowing{}.light;
    float radiance = Glowing{}.radiance;
    Texture color = Glowing{}.color;
    SharedLightSpectrum spectrum{};
    std::string group{default_group};

    template <class V>
    static void parameters(V&& v) {
        using P = GlowingParameters;
        v(&P::light, Parameter{"light", "", "Colour of the emitted light; default white.", limits::any, true});
        v(&P::radiance,
          Parameter{"radiance", "",
                    "Radiance of the surface where the colour is 1; n² times that inside a material of index n.",
                    Limits{.low = 0, .high = 1e12f, .low_open = true}, true});
        v(&P::color, Parameter{"color", "", "Reflectance; default black.", limits::any, true});
        v(&P::spectrum, spectrum_parameter);
        v(&P::group, group_parameter);
    }
    Glowing made() const { return {light, radiance, color, spectrum, checked_group(group)}; }
};

struct MixParameters {
    static constexpr KindInfo info{
        "mix",
        "A mix of two materials: iron and rust, paint and the metal under it. Neither may be clear or emit light."};

    Material first{};
    Material second{};
    Number amount = 0.5f;

    template <class V>
    static void parameters(V&& v) {
        using P = MixParameters;
        v(&P::first, Parameter{"first", "", "Material where the amount is 0."});
        v(&P::second, Parameter{"second", "", "Material where the amount is 1."});
        v(&P::amount, Parameter{"amount", "", "Fraction of the second material; between 0 and 1 the two are blended.",
                                limits::fraction, true});
    }
    Mix made() const;
};

using MaterialKinds =
    TypeList<ClearParameters, DiffuseParameters, ConductorParameters, CoatedParameters, PrincipledParameters,
             GlowingParameters, ThinGlassParameters, ThinDiffuseParameters, TwoSidedParameters, MixParameters>;

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
