#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "phasetree/io/read_kind.hpp"
#include "scene/material_kinds.hpp"
#include "scene/parameter_relations.hpp"
#include "scene/phase_entry.hpp"
#include "scene/read_parts.hpp"
#include "shading/metals.hpp"
#include "spectrum/glasses.hpp"

namespace phasetree::tracer {

std::vector<std::string_view> names_of_metals() {
    std::vector<std::string_view> names;
    for (const Metal& metal : metals()) names.push_back(metal.name);
    names.push_back("aluminum");
    return names;
}

std::vector<std::string_view> names_of_glasses() {
    std::vector<std::string_view> names;
    for (const Glass& glass : glasses()) names.push_back(glass.name);
    return names;
}

std::optional<Bump> BumpParameters::bump() const {
    check_relations(relations_of_bumps(), [&](std::string_view name) {
        return name == "bump" ? bump_texture.has_value() : bump_height.has_value();
    });
    if (!bump_texture || *bump_height == 0.0f) return std::nullopt;
    return Bump{*bump_texture, *bump_height};
}

std::optional<NormalPerturbation> PerturbationParameters::perturbation() const {
    check_relations(relations_of_normal_maps(), [&](std::string_view name) {
        return name == "bump" ? bump_texture.has_value() : normal_map.has_value();
    });
    if (normal_map) return *normal_map;
    return bump();
}

std::optional<Grain> GrainParameters::grain(const Number& roughness, std::string_view roughness_key) const {
    check_relations(relations_of_grain(), [&](std::string_view name) {
        return name == "grain_along"    ? grain_along.has_value()
               : name == "grain_around" ? grain_around.has_value()
               : name == "grain_aspect" ? grain_aspect.has_value()
                                        : grain_through.has_value();
    });
    if (!grain_along && !grain_around) return std::nullopt;
    const char* const key = grain_along ? "grain_along" : "grain_around";
    if (is_smooth(greatest_of(roughness)))
        throw ParameterError(
            key,
            fmt::format("a grain needs a rough surface; give it a \"{}\", which applies across the grain",
                        roughness_key),
            ParameterError::Place::key);
    Grain grain{.axis = glm::vec3(glm::normalize(glm::dvec3(grain_along ? *grain_along : *grain_around)))};
    if (grain_around) grain.through = grain_through.value_or(glm::vec3(0.0f));
    if (grain_aspect) grain.aspect = *grain_aspect;
    return grain;
}

std::optional<Dispersion> ClearParameters::dispersion() const {
    check_relations_of(*this, relations_of_clear());
    if (!glass && !ior) throw ParameterError("ior", "is missing");
    if (!glass && !abbe_number) return std::nullopt;
    const char* const key = glass ? "glass" : "abbe_number";
    const auto* const roughness_everywhere = std::get_if<float>(&roughness);
    if (!roughness_everywhere || *roughness_everywhere != 0.0f)
        throw ParameterError(key, "a dispersive material must be smooth; remove \"roughness\"",
                             ParameterError::Place::key);
    if (film_thickness)
        throw ParameterError(key, "a dispersive material cannot have a film; remove it", ParameterError::Place::key);
    if (glass) return find_glass(*glass).value().dispersion;
    if (*ior < 1.0f)
        throw ParameterError(key, "\"abbe_number\" requires an index of at least 1", ParameterError::Place::key);
    return Dispersion(static_cast<double>(*ior), static_cast<double>(*abbe_number));
}

Clear ClearParameters::made() const {
    const std::optional<Dispersion> disperses = dispersion();
    return {.ior = glass ? disperses->index(wavelength_of_d_line) : *ior,
            .interior = interior(),
            .roughness = roughness,
            .film = film(),
            .dispersion = disperses,
            .bump = bump()};
}

Conductor ConductorParameters::made() const {
    check_relations_of(*this, relations_of_conductor());
    if (metal) {
        const Metal found = find_metal(*metal).value();
        return {found.eta, found.k, roughness, film(), found.spectrum, perturbation(), grain(roughness)};
    }
    if (reflectance) {
        if (film_thickness)
            throw ParameterError("film_thickness",
                                 "a metal with a \"reflectance\" cannot have a film; give \"eta\" and \"k\" instead",
                                 ParameterError::Place::key);
        Conductor coloured{.roughness = roughness, .perturbation = perturbation(), .grain = grain(roughness)};
        coloured.reflectance = reflectance;
        return coloured;
    }
    if (!eta)
        throw std::invalid_argument("the conductor material needs \"metal\", \"eta\" and \"k\", or \"reflectance\"");
    return {*eta, *k, roughness, film(), {}, perturbation(), grain(roughness)};
}

Principled PrincipledParameters::made() const {
    Principled made{.base_weight = base_weight,
                    .color = base_color,
                    .diffuse_roughness = base_diffuse_roughness,
                    .metalness = base_metalness,
                    .specular_weight = specular_weight,
                    .specular_color = specular_color,
                    .roughness = specular_roughness,
                    .ior = specular_ior,
                    .coat_weight = coat_weight,
                    .coat_color = coat_color,
                    .coat_roughness = coat_roughness,
                    .coat_ior = coat_ior,
                    .coat_darkening = coat_darkening,
                    .fuzz_weight = fuzz_weight,
                    .fuzz_color = fuzz_color,
                    .fuzz_roughness = fuzz_roughness,
                    .film = film(),
                    .film_weight = film_weight,
                    .perturbation = perturbation(),
                    .grain = grain(specular_roughness, "specular_roughness")};
    if (emission_radiance > 0.0f)
        made.emission = Glowing{.light = emission_color,
                                .radiance = emission_radiance,
                                .spectrum = emission_spectrum,
                                .group = checked_group(group)};
    return made;
}

ThinGlass ThinGlassParameters::made() const {
    check_relations_of(*this, relations_of_thin_glass());
    return {ior, color, thickness ? *thickness / color_distance.value_or(1.0f) : 1.0f, roughness, perturbation()};
}

TwoSided TwoSidedParameters::made() const {
    for (const auto& [key, material] : {std::pair("front", &front), {"back", &back}}) {
        if (emission_of(*material))
            throw ParameterError(key, "a two-sided material cannot contain a material that emits light");
        if (is_thin(*material) || has_two_sides(*material))
            throw ParameterError(
                key, fmt::format("a two-sided material is opaque and cannot contain \"{}\"", kind_name(*material)));
    }
    return {std::make_shared<const Mixture>(Mixture{front, back})};
}

Mix MixParameters::made() const {
    for (const auto& [key, material] : {std::pair("first", &first), {"second", &second}})
        if (emission_of(*material)) throw ParameterError(key, "a mix cannot contain a material that emits light");
    return {std::make_shared<const Mixture>(Mixture{first, second}), amount};
}

namespace {

// Reads a material from the member that is named after its kind, which is one of these.
template <class... Kinds>
Material material_of_member(TypeList<Kinds...>, const Document& document, Value member) {
    const std::string_view names[] = {Kinds::info.name...};
    check_kind(document, member, "a material", names);
    Material material;
    const auto read = [&]<class Kind>(const Kind*) {
        material = read_kind<Kind>(document, member, fmt::format("the {} material", Kind::info.name),
                                   [](const Kind& kind) { return kind.made(); });
    };
    ((is_kind(member, Kinds::info.name) ? read(static_cast<const Kinds*>(nullptr)) : void()), ...);
    return material;
}

}  // namespace

Material read_material(const Document& document, Value value) {
    Material material;
    with_kind(MaterialKinds(), document, value, "a material",
              [&]<class Kind>(Value member) { material = material_of_member(TypeList<Kind>(), document, member); });
    return material;
}

Material read_material_of_phase(const Document& document, Value phase) {
    const PhaseEntry entry = phase_entry(document, phase);
    if (!entry.has_parameters) return read_material(document, phase);
    if (entry.material) return material_of_member(MaterialKinds(), document, *entry.material);
    throw document.error(phase, "the phase needs a material to be rendered, such as {\"diffuse\": {…}}");
}

}  // namespace phasetree::tracer
