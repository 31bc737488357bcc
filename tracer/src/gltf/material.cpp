#include "gltf/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "shading/bsdf/coating_albedo.hpp"

namespace phasetree::tracer::gltf {

namespace {

constexpr std::size_t longest_name = 60;

// A name for people, of one line.
std::string name_of(const Item& material, std::size_t index) {
    std::string name = material.text("name");
    if (name.size() > longest_name) {
        std::size_t end = longest_name;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;  // within a character of UTF-8
        name.resize(end);
    }
    std::string clean;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        // Control characters, of one byte or of two.
        const bool is_two = c == 0xC2 && i + 1 < name.size() && static_cast<unsigned char>(name[i + 1]) < 0xA0;
        if (is_two) ++i;
        clean += c < 0x20 || c == 0x7F || is_two ? '_' : name[i];
    }
    return clean.empty() ? fmt::format("material {}", index) : clean;
}

// glTF's coordinates have (0, 0) at the upper left corner of an image, and v grows downwards. KHR_texture_transform
// scales them, then turns them counter-clockwise as such axes show it, then moves them. (The matrix in its
// specification turns the other way; issue 1563 of KhronosGroup/glTF says so, and programs agree with that.)
Coordinates coordinates_of(const Item& texture) {
    Coordinates c;
    c.set = texture.index("texCoord").value_or(0);
    glm::mat3 transform(1);
    const auto extensions = texture.item("extensions");
    if (const auto t = extensions ? extensions->item("KHR_texture_transform") : std::nullopt) {
        c.set = t->index("texCoord").value_or(c.set);
        const auto offset = t->numbers("offset", 2), scale = t->numbers("scale", 2);
        const float angle = t->number("rotation", 0), cosine = std::cos(angle), sine = std::sin(angle);
        const glm::mat3 turned(glm::vec3(cosine, -sine, 0), glm::vec3(sine, cosine, 0), glm::vec3(0, 0, 1));
        if (scale)
            transform = glm::mat3(glm::vec3((*scale)[0], 0, 0), glm::vec3(0, (*scale)[1], 0), glm::vec3(0, 0, 1));
        transform = turned * transform;
        if (offset) transform[2] += glm::vec3((*offset)[0], (*offset)[1], 0);
    }
    c.transform = Coordinates::from_upper_left() * transform;
    return c;
}

glm::vec3 fraction(const glm::vec3& v) {
    return glm::clamp(v, glm::vec3(0), glm::vec3(1));
}

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

Conductor metal_of(const glm::vec3& reflectance) {
    const glm::vec3 r = glm::min(reflectance, glm::vec3(0.9999f));
    return {.eta = glm::vec3(1), .k = 2.0f * glm::sqrt(r / (1.0f - r))};
}

bool is_clear(const Item& material, const Item& pbr) {
    const auto extensions = material.item("extensions");
    if (const auto t = extensions ? extensions->item("KHR_materials_transmission") : std::nullopt)
        if (t->number("transmissionFactor", 0) > 0.5f) return true;
    const auto color = pbr.numbers("baseColorFactor", 4);
    return material.text("alphaMode") == "BLEND" && color && (*color)[3] < 0.5f;
}

}  // namespace

std::shared_ptr<const TextureImage> Materials::image(const Item& texture, ImageMeaning meaning, NamedMaterial& of) {
    const Coordinates coordinates = coordinates_of(texture);
    if (!of.coordinates)
        of.coordinates = coordinates;
    else if (of.coordinates->set != coordinates.set || of.coordinates->transform != coordinates.transform)
        of.not_shown.push_back("lays its images by different coordinates; here all lie as the first of them does");
    const Item source = document_.element("textures", texture.needed_index("index"), texture);
    const auto number = source.index("source");
    if (!number) source.fail("has no image that this program reads; images are PNG or JPEG");
    auto& made = images_[{*number, meaning}];
    if (made) return made;
    const Item item = document_.element("images", *number, source);
    const auto view = item.index("bufferView");
    if (!view) item.fail("is in another file; save all in one file, .glb");
    try {
        made = std::make_shared<const TextureImage>(
            texture_image_in_memory(document_.view(*view, item), fmt::format("{} of \"images\"", *number), meaning));
    } catch (const std::runtime_error& e) {
        throw GltfError(e.what());
    }
    if (made->pixels() > pixels_left_) throw GltfError("its images have too many pixels in all");
    pixels_left_ -= made->pixels();
    return made;
}

NamedMaterial Materials::make(const std::optional<std::size_t>& index, bool by_vertices, const Item& from) {
    static const Json none = Json::object();
    NamedMaterial made;
    const Item item = index ? document_.element("materials", *index, from) : Item(none, "the default material");
    made.name = index ? name_of(item, *index) : "without material";
    const Item pbr = item.item("pbrMetallicRoughness").value_or(Item(none, "the default material"));
    made.is_clear = is_clear(item, pbr);
    if (made.is_clear) return made;
    if (item.text("alphaMode") == "MASK" || item.text("alphaMode") == "BLEND")
        made.not_shown.push_back("has holes in the file; here it is opaque everywhere");
    if (item.has("normalTexture")) made.not_shown.push_back("has an image of normals, which are not bent here");

    TintedMeshImage color{.by_vertices = by_vertices};
    if (const auto factor = pbr.numbers("baseColorFactor", 4))
        color.factor = fraction({(*factor)[0], (*factor)[1], (*factor)[2]});
    if (const auto texture = pbr.item("baseColorTexture")) color.image = image(*texture, ImageMeaning::colors, made);

    float metallic = pbr.number("metallicFactor", 1);
    const float roughness = std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f);
    Number alpha = roughness * roughness;
    if (const auto texture = pbr.item("metallicRoughnessTexture")) {
        const auto numbers = image(*texture, ImageMeaning::numbers, made);
        metallic *= numbers->mean().z;
        MeshImageNumber map;
        map.image = std::make_shared<const TextureImage>(
            numbers->changed([&](const glm::vec3& v) { return glm::vec3(roughness * roughness * v.y * v.y); }));
        map.of_image = map.image->range(0);
        alpha = map;
    }

    const auto extensions = item.item("extensions");
    const auto extension = [&](std::string_view name) { return extensions ? extensions->item(name) : std::nullopt; };
    const auto emissive_texture = item.item("emissiveTexture");
    const glm::vec3 emissive = item.vec3("emissiveFactor", glm::vec3(0));
    const auto strength = extension("KHR_materials_emissive_strength");
    const float radiance = largest(emissive) * (strength ? strength->number("emissiveStrength", 1) : 1.0f);
    if (radiance > 0) {
        TintedMeshImage light{.factor = fraction(emissive / largest(emissive))};
        if (emissive_texture) light.image = image(*emissive_texture, ImageMeaning::colors, made);
        made.material = Glowing{.light = light, .radiance = radiance, .color = color};
    } else if (metallic >= 0.5f) {
        Conductor metal = metal_of(color.factor * (color.image ? color.image->mean() : glm::vec3(1)));
        metal.roughness = alpha;
        made.material = metal;
        if (color.image || by_vertices)
            made.not_shown.push_back("is a metal of several colours; here it has their mean");
    } else {
        const auto given = extension("KHR_materials_ior");
        const float ior = std::clamp(given ? given->number("ior", 1.5f) : 1.5f, 1.01f, 4.0f);
        color.internal_reflectance = CoatingAlbedo(ior, 0.0f).at(0.0f).internal().x;
        made.material = Coated{.color = color, .ior = ior, .roughness = alpha};
    }
    return made;
}

}  // namespace phasetree::tracer::gltf
