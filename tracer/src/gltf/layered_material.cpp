#include "gltf/layered_material.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "shading/thin_film.hpp"

namespace phasetree::tracer::gltf {

namespace {

bool has_specular(const Item& material) {
    const auto specular = material.extension("KHR_materials_specular");
    return specular && (specular->number("specularFactor", 1) != 1 || specular->has("specularTexture") ||
                        specular->has("specularColorTexture") ||
                        specular->vec3("specularColorFactor", glm::vec3(1)) != glm::vec3(1));
}

void add_coat(MaterialReader& reader, Principled& all) {
    const auto coat = reader.extension("KHR_materials_clearcoat");
    const float weight = coat ? fraction_of(*coat, "clearcoatFactor", 0) : 0;
    if (!(weight > 0)) return;
    all.coat_weight = reader.factor(*coat, "clearcoatTexture", weight, 0, ImageMeaning::numbers);
    all.coat_roughness = reader.factor(*coat, "clearcoatRoughnessTexture",
                                       fraction_of(*coat, "clearcoatRoughnessFactor", 0), 1, ImageMeaning::numbers);
    all.coat_ior = 1.5f;
    all.coat_darkening = 0.0f;  // glTF has none
    if (all.perturbation.has_value() != coat->has("clearcoatNormalTexture"))
        reader.note_loss("has different normals on its clear coat, which are ignored; it has those of the base");
}

void add_fuzz(MaterialReader& reader, Principled& all) {
    const auto sheen = reader.extension("KHR_materials_sheen");
    const glm::vec3 color = sheen ? fraction(sheen->vec3("sheenColorFactor", glm::vec3(0))) : glm::vec3(0);
    if (!(largest(color) > 0)) return;
    // In glTF, the largest component of the colour determines how much of the base is hidden.
    all.fuzz_weight = largest(color);
    all.fuzz_color = reader.color_factor(*sheen, "sheenColorTexture", color / largest(color));
    all.fuzz_roughness = reader.factor(*sheen, "sheenRoughnessTexture", fraction_of(*sheen, "sheenRoughnessFactor", 0),
                                       0, ImageMeaning::alpha);
}

void add_film(MaterialReader& reader, Principled& all) {
    const auto film = reader.extension("KHR_materials_iridescence");
    const float weight = film ? fraction_of(*film, "iridescenceFactor", 0) : 0;
    if (!(weight > 0)) return;
    const auto thickness = [&](std::string_view key, float otherwise) {
        return std::clamp(film->number(key, otherwise), 0.0f, ThinFilm::thickest);
    };
    all.film_weight = reader.factor(*film, "iridescenceTexture", weight, 0, ImageMeaning::numbers);
    all.film = SurfaceFilm{
        .thickness = reader.factor(*film, "iridescenceThicknessTexture", thickness("iridescenceThicknessMaximum", 400),
                                   1, ImageMeaning::numbers, thickness("iridescenceThicknessMinimum", 100)),
        .ior = std::clamp(film->number("iridescenceIor", 1.3f), 1.0f, 4.0f)};
}

// glTF increases the roughness along a direction in the tangent plane, to α + (1 − α) strength². Grooves are
// perpendicular to it.
void add_grain(MaterialReader& reader, const BaseSurface& base, Principled& all) {
    const auto anisotropy = reader.extension("KHR_materials_anisotropy");
    const float strength = anisotropy ? fraction_of(*anisotropy, "anisotropyStrength", 0) : 0;
    if (!(strength > 0)) return;
    if (anisotropy->has("anisotropyTexture")) reader.note_loss("has an image of its anisotropy, which is ignored");
    if (!std::holds_alternative<float>(base.roughness))
        reader.note_loss("is anisotropic and has an image of its roughness, whose mean is used");
    const float alpha = std::max(base.mean_roughness * base.mean_roughness, 1e-3f);
    const float stretched = alpha + (1 - alpha) * strength * strength;
    const float turn = anisotropy->number("anisotropyRotation", 0);
    all.roughness = std::sqrt(stretched);
    all.grain = Grain{.aspect = std::clamp(alpha / stretched, 0.1f, 1.0f),
                      .in_tangents = glm::vec2(-std::sin(turn), std::cos(turn))};
    // Tangents are those of texture coordinates.
    if (!reader.made().coordinates) reader.made().coordinates = Coordinates();
}

void add_specular(MaterialReader& reader, Principled& all) {
    const auto specular = reader.extension("KHR_materials_specular");
    const glm::vec3 color = specular->vec3("specularColorFactor", glm::vec3(1));
    if (largest(color) > 1) reader.note_loss("has a specular colour above 1, which is clamped");
    all.specular_weight = reader.factor(*specular, "specularTexture", fraction_of(*specular, "specularFactor", 1), 0,
                                        ImageMeaning::alpha);
    all.specular_color = reader.color_factor(*specular, "specularColorTexture", color);
}

}  // namespace

bool has_layers(const Item& material, const Item& pbr) {
    const auto has = [&](std::string_view name, std::string_view factor) {
        const auto found = material.extension(name);
        return found && found->number(factor, 0) > 0;
    };
    const auto sheen = material.extension("KHR_materials_sheen");
    const bool is_metal = pbr.number("metallicFactor", 1) > nearly_all_metal && !pbr.has("metallicRoughnessTexture");
    return has("KHR_materials_clearcoat", "clearcoatFactor") || has("KHR_materials_anisotropy", "anisotropyStrength") ||
           has("KHR_materials_iridescence", "iridescenceFactor") ||
           (sheen && largest(sheen->vec3("sheenColorFactor", glm::vec3(0))) > 0) ||
           (has_specular(material) && !is_metal);
}

Material layered_material(MaterialReader& reader, const BaseSurface& base, const std::optional<NormalMap>& normals,
                          std::optional<Glowing> glowing) {
    Principled all{.color = base.color,
                   .metalness = base.metallic,
                   .roughness = base.roughness,
                   .ior = reader.index(),
                   .perturbation = normals,
                   .emission = std::move(glowing)};
    if (least_of(base.metallic) > nearly_all_metal) all.metalness = 1.0f;
    if (greatest_of(base.metallic) < 1 - nearly_all_metal) all.metalness = 0.0f;
    add_coat(reader, all);
    add_fuzz(reader, all);
    add_film(reader, all);
    add_grain(reader, base, all);
    if (!has_specular(reader.item()) || least_of(all.metalness) == 1.0f) return all;
    // glTF's specular extension does not apply to metal. A mix cannot contain materials that emit light.
    if (greatest_of(all.metalness) == 0.0f || all.emission) {
        if (greatest_of(all.metalness) > 0.0f)
            reader.note_loss("is partly metallic and emissive; its specular factors apply to its metal, too");
        add_specular(reader, all);
        return all;
    }
    Principled metal = all;
    metal.metalness = 1.0f;
    all.metalness = 0.0f;
    add_specular(reader, all);
    return Mix{std::make_shared<const Mixture>(Mixture{std::move(all), std::move(metal)}), base.metallic};
}

}  // namespace phasetree::tracer::gltf
