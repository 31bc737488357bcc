#include "gltf/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "gltf/layered_material.hpp"
#include "gltf/material_reader.hpp"
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

// Surfaces that emit less are shown as dark.
constexpr float faintest_radiance = 0.01f;

}  // namespace

// Makes one material.
class Materials::Maker : MaterialReader {
  public:
    Maker(Images& images, const Item& item, ReadPanes panes, bool wants_clear, NamedMaterial& made)
        : MaterialReader(images, item, made),
          images_(images),
          item_(item),
          panes_(panes),
          wants_clear_(wants_clear),
          made_(made) {}

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
        const bool is_layered = has_layers(item_, pbr);
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
            made_.material = layered_material(*this, base_, normals, std::move(glowing));
            if (!emits) made_.material = translucent(std::move(made_.material), normals);
            return;
        }
        if (glowing) {
            glowing->color = base_.color;
            made_.material = std::move(*glowing);
            return;
        }
        read_roughness(pbr);
        if (least_of(base_.metallic) > nearly_all_metal)
            made_.material = metal(normals);
        else if (greatest_of(base_.metallic) < 1 - nearly_all_metal)
            made_.material = translucent(coated(normals), normals);
        else
            made_.material =
                Mix{std::make_shared<const Mixture>(Mixture{translucent(coated(normals), normals), metal(normals)}),
                    base_.metallic};
    }

  private:
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
            opaque = with_diffuse_transmission({base_.color, 0.0f, normals}, base_.color, color, part);
        }
        if (!made_.is_pane) return opaque;
        const auto transmission = extension("KHR_materials_transmission");
        const Number part = factor(*transmission, "transmissionTexture", share_of(transmission, "transmissionFactor"),
                                   0, ImageMeaning::numbers);
        return with_pane(std::move(opaque), {index(), base_.color, 1.0f, base_.alpha, normals}, part);
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
        base_.color.by_vertices = by_vertices;
        if (const auto factor = pbr.numbers("baseColorFactor", 4))
            base_.color.factor = fraction({(*factor)[0], (*factor)[1], (*factor)[2]});
        const auto texture = pbr.item("baseColorTexture");
        if (const auto read = image(texture, ImageMeaning::colors)) {
            base_.color.image = read->image;
            base_.color.coordinates = lay(*texture, *read);
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
        base_.metallic = metallic;
        base_.mean_roughness = std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f);
        // Surfaces of the same roughness share their tables, which take a tenth of a second to make. A difference of
        // 1/64 is invisible.
        const float roughness = std::round(32 * std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f)) / 32;
        base_.roughness = roughness;
        base_.alpha = roughness * roughness;
        const auto texture = pbr.item("metallicRoughnessTexture");
        if (const auto read = image(texture, ImageMeaning::numbers)) {
            const ImageCoordinates coordinates = lay(*texture, *read);
            base_.metallic = MeshImageNumber{.range = {0, metallic},
                                             .image = read->image,
                                             .of_image = read->blue,
                                             .channel = 2,
                                             .coordinates = coordinates};
            base_.alpha = MeshImageNumber{.range = {0, roughness},
                                          .image = read->image,
                                          .of_image = read->green_in_quarters(),
                                          .channel = 1,
                                          .is_squared = true,
                                          .coordinates = coordinates};
            MeshImageNumber perceived = std::get<MeshImageNumber>(base_.alpha);
            perceived.is_squared = false;
            base_.roughness = perceived;
            base_.mean_roughness *= read->mean.y;
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
        Conductor metal{.eta = glm::vec3(1),
                        .k = k_of_reflectance(base_.color.factor),
                        .roughness = base_.alpha,
                        .perturbation = normals};
        if (base_.color.image || base_.color.by_vertices) metal.reflectance = base_.color;
        return metal;
    }

    Coated coated(const std::optional<NormalMap>& normals) const {
        const float ior = index();
        TintedMeshImage base = base_.color;
        base.internal_reflectance = CoatingAlbedo(ior, 0.0f).at(0.0f).internal().x;
        return {.color = base, .ior = ior, .roughness = base_.alpha, .perturbation = normals};
    }

    Images& images_;
    const Item& item_;
    ReadPanes panes_;
    bool wants_clear_;
    NamedMaterial& made_;
    BaseSurface base_;
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
