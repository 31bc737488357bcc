#include "view/edits.hpp"

#include <algorithm>
#include <cmath>

#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/remove.hpp"
#include "scene/material_kinds.hpp"

namespace phasetree::tracer::view {

namespace {

// Black would have unbounded absorption.
constexpr float darkest = 1e-4f;
// The index of refraction of a phase that is made clear and had none: that of glass.
constexpr float usual_ior = 1.5f;

std::optional<float> constant(const Number& number) {
    const auto* value = std::get_if<float>(&number);
    return value ? std::optional<float>(*value) : std::nullopt;
}

std::optional<glm::vec3> constant(const Texture& texture) {
    const auto* value = std::get_if<ConstantTexture>(&texture);
    return value ? std::optional<glm::vec3>(value->color) : std::nullopt;
}

// The colour of a clear phase's interior. Scattering media, such as milk, have none.
std::optional<glm::vec3> color_of(const Medium& medium, float depth) {
    const auto* absorbing = std::get_if<AbsorbingMedium>(&medium);
    return absorbing ? std::optional<glm::vec3>(beer_lambert(absorbing->absorption.rgb(), depth)) : std::nullopt;
}

Medium medium_of(const glm::vec3& color, float depth) {
    return AbsorbingMedium{Absorption::left_after(glm::clamp(color, darkest, 1.0f), depth)};
}

Clear made_clear(const Optics& optics) {
    const float roughness = optics.roughness.value_or(0.0f);
    // The roughness of layers is the square root of the α that clear materials have.
    const bool is_root = optics.kind == PrincipledParameters::info.name;
    return {.ior = optics.ior.value_or(usual_ior), .roughness = is_root ? roughness * roughness : roughness};
}

Material looking(const Material& material, const Look& look, float depth) {
    Material result = material;
    if (look.is_clear && !is_clear(material)) result = made_clear(optics_of(material, depth));
    std::visit(
        [&]<class Kind>(Kind& kind) {
            if constexpr (requires { kind.interior; }) {
                if (look.color) kind.interior = medium_of(*look.color, depth);
            } else if constexpr (requires { kind.color; }) {
                if (look.color) kind.color = ConstantTexture{*look.color};
            }
            if constexpr (requires { kind.ior; })
                if (look.ior) kind.ior = *look.ior;
            if constexpr (requires { kind.roughness; })
                if (look.roughness) kind.roughness = *look.roughness;
            // A dispersive glass has an index per wavelength, and is smooth.
            if constexpr (requires { kind.dispersion; })
                if (look.ior || look.roughness) kind.dispersion.reset();
        },
        result);
    return result;
}

Phased without_phases(const Scene& scene, const std::vector<std::string>& hidden) {
    PhaseSet gone;
    const std::vector<std::string>& names = scene.phases.names;
    for (std::size_t i = 1; i < names.size(); ++i)
        if (std::ranges::find(hidden, names[i]) != hidden.end())
            gone = gone | PhaseSet::of(Phase{static_cast<std::uint8_t>(i)});
    if (gone.bits == 0) return scene.object;
    return Remove{.of = scene.object, .gone = gone};
}

}  // namespace

Optics optics_of(const Material& material, float depth) {
    Optics optics;
    optics.kind = kind_name(material);
    std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (requires { kind.interior; })
                optics.color = color_of(kind.interior, depth);
            else if constexpr (requires { kind.color; })
                optics.color = constant(kind.color);
            else
                optics.has_color = false;
            if constexpr (requires { kind.ior; }) optics.ior = kind.ior;
            if constexpr (requires { kind.roughness; })
                optics.roughness = constant(kind.roughness);
            else
                optics.has_roughness = false;
        },
        material);
    return optics;
}

Optics looking(const Optics& optics, const Look& look) {
    Optics result = optics;
    if (look.is_clear && optics.kind != "clear") {
        const Clear clear = made_clear(optics);
        result = {.kind = "clear", .color = glm::vec3(1.0f), .ior = clear.ior, .roughness = constant(clear.roughness)};
    }
    if (look.color && result.has_color) result.color = look.color;
    if (look.ior && result.ior) result.ior = look.ior;
    if (look.roughness && result.has_roughness) result.roughness = look.roughness;
    return result;
}

float half_diagonal(const Phased& object) {
    const Bounds bounds = phasetree::bounds(object);
    return bounds.empty() || !bounds.finite() ? 1.0f : 0.5f * bounds.diagonal();
}

Scene edited(const Scene& scene, const Edits& edits) {
    Scene result = scene;
    // Computed from the unedited scene, because colours must not change when a part is hidden or cut off.
    const float depth = half_diagonal(scene.object);
    for (std::size_t i = 1; i < scene.phases.names.size(); ++i)
        if (const auto look = edits.looks.find(scene.phases.names[i]); look != edits.looks.end())
            result.materials[i] = looking(scene.materials[i], look->second, depth);
    result.object = without_phases(scene, edits.hidden);
    if (edits.cut)
        result.object =
            IntersectShape{.of = result.object, .shape = Plane{edits.cut->normal, edits.cut->offset}, .phases_cut = {}};
    return result;
}

}  // namespace phasetree::tracer::view
