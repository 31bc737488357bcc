#include "gltf/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <string_view>
#include <utility>

#include "gltf/names.hpp"
#include "shading/bsdf/coating_albedo.hpp"
#include "shading/fresnel.hpp"

namespace phasetree::tracer::gltf {

namespace {

// The name of a material in messages.
std::string name_of_material(const Item& material, std::size_t index) {
    const std::string name = clean_name(material.text("name"));
    return name.empty() ? fmt::format("material {}", index) : name;
}

glm::vec3 fraction(const glm::vec3& v) {
    return glm::clamp(v, glm::vec3(0), glm::vec3(1));
}

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

// Surfaces that emit less are shown as dark.
constexpr float faintest_radiance = 0.01f;

// A surface whose metallic factor exceeds this everywhere counts as metal.
constexpr float nearly_all = 0.99f;

}  // namespace

// Makes one material.
class Materials::Maker {
  public:
    Maker(Images& images, const Item& item, ReadPanes panes, bool wants_clear, NamedMaterial& made)
        : images_(images), item_(item), panes_(panes), wants_clear_(wants_clear), made_(made) {}

    void make(bool by_vertices) {
        const auto given = item_.item("pbrMetallicRoughness");
        static const Json none = Json::object();
        const Item pbr = given.value_or(Item(none, "the default material"));
        made_.is_pane = panes_ == ReadPanes::as_thin_glass && is_pane();
        if (!made_.is_pane && is_clear()) {
            made_.is_clear = true;
            if (wants_clear_) made_.clear = clear_material(item_, images_, made_.not_shown);
            return;
        }
        if (const auto extensions = item_.item("extensions")) made_.extensions = extensions->keys();
        if (!given && extension("KHR_materials_pbrSpecularGlossiness"))
            note_loss("uses the specular-glossiness workflow, which is not supported; it is rendered as a white metal");
        // The first image decides which coordinates the mesh has. Tangents belong to these, so a normal map comes
        // first.
        const bool is_layered = has_layers(pbr);
        std::optional<NormalMap> normals = is_layered ? normal_map() : std::nullopt;
        std::optional<Glowing> glowing = emission(is_layered);
        if (!glowing && !is_layered) normals = normal_map();
        read_color(pbr, by_vertices);
        read_opacity(pbr, by_vertices);
        const bool transmits_diffusely =
            share_of(extension("KHR_materials_diffuse_transmission"), "diffuseTransmissionFactor") > 0;
        if (glowing && (made_.is_pane || transmits_diffusely)) {
            note_loss("emits light and is translucent; it is rendered as opaque");
            made_.is_pane = false;
        }
        if (is_layered) {
            read_roughness(pbr);
            const bool emits = glowing.has_value();
            made_.material = layers(normals, std::move(glowing));
            if (!emits) made_.material = translucent(std::move(made_.material), normals);
            return;
        }
        if (glowing) {
            glowing->color = color_;
            made_.material = std::move(*glowing);
            return;
        }
        read_roughness(pbr);
        if (least_of(metallic_) > nearly_all)
            made_.material = metal(normals);
        else if (greatest_of(metallic_) < 1 - nearly_all)
            made_.material = translucent(coated(normals), normals);
        else
            made_.material =
                Mix{std::make_shared<const Mixture>(Mixture{translucent(coated(normals), normals), metal(normals)}),
                    metallic_};
    }

  private:
    void note_loss(std::string sentence) { made_.not_shown.push_back(std::move(sentence)); }

    std::optional<Item> extension(std::string_view name) const { return item_.extension(name); }

    // Reads the image of a texture. Reports an image in a format that is not read.
    std::optional<ReadImage> image(const std::optional<Item>& texture, ImageMeaning meaning) {
        if (!texture) return std::nullopt;
        const auto read = images_.read(*texture, meaning);
        if (!read && meaning != ImageMeaning::alpha)
            note_loss("has an image in an unsupported format, which is ignored; use PNG or JPEG");
        return read;
    }
    // How an image is mapped onto meshes. The first image of a material determines the meshes' texture coordinates. The
    // others use these, too, or a second set.
    ImageCoordinates lay(const Item& texture, const ReadImage& image) {
        if (!image.repeats) note_loss("has an image that must not repeat; it is rendered as repeating");
        const Coordinates wanted = coordinates_of(texture);
        if (!made_.coordinates) made_.coordinates = wanted;
        const Coordinates& first = *made_.coordinates;
        if (first == wanted) return {};
        if (first.set == wanted.set && is_invertible(first.transform))
            return {.is_second = false, .transform = glm::mat3x2(wanted.transform * glm::inverse(first.transform))};
        if (!made_.second_set) made_.second_set = wanted.set;
        if (*made_.second_set != wanted.set) {
            note_loss("uses more than two sets of texture coordinates; one image is mapped by another set");
            return {};
        }
        ImageCoordinates second{.is_second = true};
        if (wanted.transform != Coordinates::from_upper_left())
            second.transform = glm::mat3x2(wanted.transform * glm::inverse(Coordinates::from_upper_left()));
        return second;
    }
    static bool is_invertible(const glm::mat3& m) {
        constexpr float smallest = 1e-12f;
        return std::abs(glm::determinant(m)) > smallest;
    }

    static float share_of(const std::optional<Item>& owner, std::string_view factor) {
        return owner ? fraction_of(*owner, factor, 0) : 0.0f;
    }
    bool is_pane() const {
        return share_of(extension("KHR_materials_transmission"), "transmissionFactor") > 0 && !has_volume(item_);
    }
    // A material that is not metal, with what its extensions let through.
    Material translucent(Material opaque, const std::optional<NormalMap>& normals) {
        const auto diffuse = extension("KHR_materials_diffuse_transmission");
        if (const float share = share_of(diffuse, "diffuseTransmissionFactor"); share > 0) {
            note_loss("transmits light diffusely and loses its gloss");
            const Number part = factor(*diffuse, "diffuseTransmissionTexture", share, 0, ImageMeaning::alpha);
            const Texture color = color_factor(*diffuse, "diffuseTransmissionColorTexture",
                                               diffuse->vec3("diffuseTransmissionColorFactor", glm::vec3(1)));
            opaque = with_diffuse_transmission({color_, 0.0f, normals}, color_, color, part);
        }
        if (!made_.is_pane) return opaque;
        const auto transmission = extension("KHR_materials_transmission");
        const Number part = factor(*transmission, "transmissionTexture", share_of(transmission, "transmissionFactor"),
                                   0, ImageMeaning::numbers);
        return with_pane(std::move(opaque), {index(), color_, 1.0f, alpha_, normals}, part);
    }

    bool is_clear() {
        const auto transmission = extension("KHR_materials_transmission");
        if (!transmission) return false;
        float part = transmission->number("transmissionFactor", 0);
        if (part > 0)
            if (const auto read = image(transmission->item("transmissionTexture"), ImageMeaning::numbers))
                part *= read->mean.x;
        if (part >= 0.5f) return true;
        if (part > 0) note_loss("is partly transmissive; it is rendered as opaque");
        return false;
    }

    void read_color(const Item& pbr, bool by_vertices) {
        color_.by_vertices = by_vertices;
        if (const auto factor = pbr.numbers("baseColorFactor", 4))
            color_.factor = fraction({(*factor)[0], (*factor)[1], (*factor)[2]});
        const auto texture = pbr.item("baseColorTexture");
        if (const auto read = image(texture, ImageMeaning::colors)) {
            color_.image = read->image;
            color_.coordinates = lay(*texture, *read);
        }
    }
    void read_opacity(const Item& pbr, bool by_vertices) {
        const std::string mode = item_.text("alphaMode");
        if (mode != "MASK" && mode != "BLEND") return;
        const auto factor = pbr.numbers("baseColorFactor", 4);
        const float alpha = factor ? std::clamp((*factor)[3], 0.0f, 1.0f) : 1.0f;
        Opacity opacity{.number = alpha, .by_vertices = by_vertices};
        const auto texture = pbr.item("baseColorTexture");
        const auto read = image(texture, ImageMeaning::alpha);
        if (read) {
            opacity.number = MeshImageNumber{.range = {0, alpha},
                                             .image = read->image,
                                             .of_image = read->image->range(0),
                                             .coordinates = lay(*texture, *read)};
        }
        if (mode == "MASK") opacity.cutoff = std::max(item_.number("alphaCutoff", 0.5f), 0.0f);
        if (by_vertices || opacity.least() < opacity.cutoff.value_or(1)) made_.opacity = opacity;
    }

    void read_roughness(const Item& pbr) {
        // Metal, which glTF's materials are by default, transmits nothing; a pane without the factor is not meant to
        // be.
        const float metallic = std::clamp(pbr.number("metallicFactor", made_.is_pane ? 0.0f : 1.0f), 0.0f, 1.0f);
        metallic_ = metallic;
        mean_roughness_ = std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f);
        // Surfaces of the same roughness share their tables, which take a tenth of a second to make. A difference of
        // 1/64 is invisible.
        const float roughness = std::round(32 * std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f)) / 32;
        roughness_ = roughness;
        alpha_ = roughness * roughness;
        const auto texture = pbr.item("metallicRoughnessTexture");
        if (const auto read = image(texture, ImageMeaning::numbers)) {
            const ImageCoordinates coordinates = lay(*texture, *read);
            metallic_ = MeshImageNumber{.range = {0, metallic},
                                        .image = read->image,
                                        .of_image = read->blue,
                                        .channel = 2,
                                        .coordinates = coordinates};
            alpha_ = MeshImageNumber{.range = {0, roughness},
                                     .image = read->image,
                                     .of_image = read->green_in_quarters(),
                                     .channel = 1,
                                     .is_squared = true,
                                     .coordinates = coordinates};
            MeshImageNumber perceived = std::get<MeshImageNumber>(alpha_);
            perceived.is_squared = false;
            roughness_ = perceived;
            mean_roughness_ *= read->mean.y;
        }
    }

    std::optional<NormalMap> normal_map() {
        const auto texture = item_.item("normalTexture");
        const auto read = image(texture, ImageMeaning::numbers);
        if (!read) return std::nullopt;
        (void)lay(*texture, *read);  // it is the first
        return NormalMap{.strength = std::clamp(texture->number("scale", 1), -100.0f, 100.0f), .image = read->image};
    }

    // Its emission, without its colour; nullopt if it is dark.
    std::optional<Glowing> emission(bool keeps_normal_map) {
        const glm::vec3 emissive = item_.vec3("emissiveFactor", glm::vec3(0));
        const auto strength = extension("KHR_materials_emissive_strength");
        const float radiance = largest(emissive) * (strength ? strength->number("emissiveStrength", 1) : 1.0f);
        if (!(radiance > 0)) return std::nullopt;
        if (radiance < faintest_radiance) {
            note_loss("is faintly emissive; it is rendered without emission");
            return std::nullopt;
        }
        TintedMeshImage light{.factor = fraction(emissive / largest(emissive))};
        const auto texture = item_.item("emissiveTexture");
        const auto read = image(texture, ImageMeaning::colors);
        // If the image that shows where the surface emits cannot be read, the surface is assumed to be dark.
        if (texture && !read) return std::nullopt;
        if (read) {
            if (read->lit_share < 0.5f) {
                if (read->lit_share > 0) note_loss("is emissive in some places; it is rendered without emission");
                return std::nullopt;
            }
            light.image = read->image;
            light.coordinates = lay(*texture, *read);
        }
        if (item_.has("normalTexture") && !keeps_normal_map)
            note_loss("is emissive and has a normal map, which is ignored");
        return Glowing{.light = light, .radiance = radiance};
    }

    Conductor metal(const std::optional<NormalMap>& normals) const {
        Conductor metal{
            .eta = glm::vec3(1), .k = k_of_reflectance(color_.factor), .roughness = alpha_, .perturbation = normals};
        if (color_.image || color_.by_vertices) metal.reflectance = color_;
        return metal;
    }

    float index() const {
        const auto ior_extension = extension("KHR_materials_ior");
        // In glTF, 0 means that other extensions determine the reflection.
        const float wanted = ior_extension ? ior_extension->number("ior", 1.5f) : 1.5f;
        return wanted > 0 ? std::clamp(wanted, 1.01f, 4.0f) : 1.5f;
    }

    Coated coated(const std::optional<NormalMap>& normals) const {
        const float ior = index();
        TintedMeshImage base = color_;
        base.internal_reflectance = CoatingAlbedo(ior, 0.0f).at(0.0f).internal().x;
        return {.color = base, .ior = ior, .roughness = alpha_, .perturbation = normals};
    }

    // Whether one of its extensions needs `principled`.
    bool has_layers(const Item& pbr) const {
        const auto has = [&](std::string_view name, std::string_view factor) {
            const auto found = extension(name);
            return found && found->number(factor, 0) > 0;
        };
        const auto sheen = extension("KHR_materials_sheen");
        const bool is_metal = pbr.number("metallicFactor", 1) > nearly_all && !pbr.has("metallicRoughnessTexture");
        return has("KHR_materials_clearcoat", "clearcoatFactor") ||
               has("KHR_materials_anisotropy", "anisotropyStrength") ||
               has("KHR_materials_iridescence", "iridescenceFactor") ||
               (sheen && largest(sheen->vec3("sheenColorFactor", glm::vec3(0))) > 0) || (has_specular() && !is_metal);
    }
    bool has_specular() const {
        const auto specular = extension("KHR_materials_specular");
        return specular && (specular->number("specularFactor", 1) != 1 || specular->has("specularTexture") ||
                            specular->has("specularColorTexture") ||
                            specular->vec3("specularColorFactor", glm::vec3(1)) != glm::vec3(1));
    }

    Material layers(const std::optional<NormalMap>& normals, std::optional<Glowing> glowing) {
        Principled all{.color = color_,
                       .metalness = metallic_,
                       .roughness = roughness_,
                       .ior = index(),
                       .perturbation = normals,
                       .emission = std::move(glowing)};
        if (least_of(metallic_) > nearly_all) all.metalness = 1.0f;
        if (greatest_of(metallic_) < 1 - nearly_all) all.metalness = 0.0f;
        add_coat(all);
        add_fuzz(all);
        add_film(all);
        add_grain(all);
        if (!has_specular() || least_of(all.metalness) == 1.0f) return all;
        // glTF's specular extension does not apply to metal. A mix cannot contain materials that emit light.
        if (greatest_of(all.metalness) == 0.0f || all.emission) {
            if (greatest_of(all.metalness) > 0.0f)
                note_loss("is partly metallic and emissive; its specular factors apply to its metal, too");
            add_specular(all);
            return all;
        }
        Principled metal = all;
        metal.metalness = 1.0f;
        all.metalness = 0.0f;
        add_specular(all);
        return Mix{std::make_shared<const Mixture>(Mixture{std::move(all), std::move(metal)}), metallic_};
    }

    // A factor times a channel of an image, if there is one: `at_0` where the channel is 0, `value` where it is 1.
    Number factor(const Item& owner, std::string_view texture_key, float value, int channel, ImageMeaning meaning,
                  float at_0 = 0) {
        const auto texture = owner.item(texture_key);
        const auto read = image(texture, meaning);
        if (!read) return value;
        const glm::vec2 range = read->image->range(channel);
        // Ranges are rounded to quarters, so that images share tables.
        return MeshImageNumber{.range = {at_0, value},
                               .image = read->image,
                               .of_image = {std::floor(4 * range.x) / 4, std::ceil(4 * range.y) / 4},
                               .channel = channel,
                               .coordinates = lay(*texture, *read)};
    }
    Texture color_factor(const Item& owner, std::string_view texture_key, const glm::vec3& value) {
        const auto texture = owner.item(texture_key);
        const auto read = image(texture, ImageMeaning::colors);
        if (!read) return ConstantTexture{fraction(value)};
        return TintedMeshImage{.factor = fraction(value), .image = read->image, .coordinates = lay(*texture, *read)};
    }
    static float fraction_of(const Item& owner, std::string_view key, float otherwise) {
        return std::clamp(owner.number(key, otherwise), 0.0f, 1.0f);
    }

    void add_coat(Principled& all) {
        const auto coat = extension("KHR_materials_clearcoat");
        const float weight = coat ? fraction_of(*coat, "clearcoatFactor", 0) : 0;
        if (!(weight > 0)) return;
        all.coat_weight = factor(*coat, "clearcoatTexture", weight, 0, ImageMeaning::numbers);
        all.coat_roughness = factor(*coat, "clearcoatRoughnessTexture",
                                    fraction_of(*coat, "clearcoatRoughnessFactor", 0), 1, ImageMeaning::numbers);
        all.coat_ior = 1.5f;
        all.coat_darkening = 0.0f;  // glTF has none
        if (all.perturbation.has_value() != coat->has("clearcoatNormalTexture"))
            note_loss("has different normals on its clear coat, which are ignored; it has those of the base");
    }
    void add_fuzz(Principled& all) {
        const auto sheen = extension("KHR_materials_sheen");
        const glm::vec3 color = sheen ? fraction(sheen->vec3("sheenColorFactor", glm::vec3(0))) : glm::vec3(0);
        if (!(largest(color) > 0)) return;
        // In glTF, the largest component of the colour determines how much of the base is hidden.
        all.fuzz_weight = largest(color);
        all.fuzz_color = color_factor(*sheen, "sheenColorTexture", color / largest(color));
        all.fuzz_roughness = factor(*sheen, "sheenRoughnessTexture", fraction_of(*sheen, "sheenRoughnessFactor", 0), 0,
                                    ImageMeaning::alpha);
    }
    void add_film(Principled& all) {
        const auto film = extension("KHR_materials_iridescence");
        const float weight = film ? fraction_of(*film, "iridescenceFactor", 0) : 0;
        if (!(weight > 0)) return;
        const auto thickness = [&](std::string_view key, float otherwise) {
            return std::clamp(film->number(key, otherwise), 0.0f, ThinFilm::thickest);
        };
        all.film_weight = factor(*film, "iridescenceTexture", weight, 0, ImageMeaning::numbers);
        all.film = SurfaceFilm{
            .thickness = factor(*film, "iridescenceThicknessTexture", thickness("iridescenceThicknessMaximum", 400), 1,
                                ImageMeaning::numbers, thickness("iridescenceThicknessMinimum", 100)),
            .ior = std::clamp(film->number("iridescenceIor", 1.3f), 1.0f, 4.0f)};
    }
    // glTF increases the roughness along a direction in the tangent plane, to α + (1 − α) strength². Grooves are
    // perpendicular to it.
    void add_grain(Principled& all) {
        const auto anisotropy = extension("KHR_materials_anisotropy");
        const float strength = anisotropy ? fraction_of(*anisotropy, "anisotropyStrength", 0) : 0;
        if (!(strength > 0)) return;
        if (anisotropy->has("anisotropyTexture")) note_loss("has an image of its anisotropy, which is ignored");
        if (!std::holds_alternative<float>(roughness_))
            note_loss("is anisotropic and has an image of its roughness, whose mean is used");
        const float alpha = std::max(mean_roughness_ * mean_roughness_, 1e-3f);
        const float stretched = alpha + (1 - alpha) * strength * strength;
        const float turn = anisotropy->number("anisotropyRotation", 0);
        all.roughness = std::sqrt(stretched);
        all.grain = Grain{.aspect = std::clamp(alpha / stretched, 0.1f, 1.0f),
                          .in_tangents = glm::vec2(-std::sin(turn), std::cos(turn))};
        // Tangents are those of texture coordinates.
        if (!made_.coordinates) made_.coordinates = Coordinates();
    }
    void add_specular(Principled& all) {
        const auto specular = extension("KHR_materials_specular");
        const glm::vec3 color = specular->vec3("specularColorFactor", glm::vec3(1));
        if (largest(color) > 1) note_loss("has a specular colour above 1, which is clamped");
        all.specular_weight =
            factor(*specular, "specularTexture", fraction_of(*specular, "specularFactor", 1), 0, ImageMeaning::alpha);
        all.specular_color = color_factor(*specular, "specularColorTexture", color);
    }

    Images& images_;
    const Item& item_;
    ReadPanes panes_;
    bool wants_clear_;
    NamedMaterial& made_;
    TintedMeshImage color_;
    Number metallic_ = 1.0f;
    Number roughness_ = 1.0f, alpha_ = 1.0f;  // alpha_ is that of GGX, the square
    float mean_roughness_ = 1.0f;
};

NamedMaterial Materials::make(const std::optional<std::size_t>& index, bool by_vertices, const Item& from) {
    static const Json none = Json::object();
    NamedMaterial made;
    const Item item = index ? document_.element("materials", *index, from) : Item(none, "the default material");
    made.name = index ? name_of_material(item, *index) : "without material";
    Maker(images_, item, panes_, wants_clear_, made).make(by_vertices);
    return made;
}

}  // namespace phasetree::tracer::gltf
