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

glm::vec3 fraction(const glm::vec3& v) {
    return glm::clamp(v, glm::vec3(0), glm::vec3(1));
}

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

bool is_clear(const Item& material, const Item& pbr) {
    const auto extensions = material.item("extensions");
    if (const auto t = extensions ? extensions->item("KHR_materials_transmission") : std::nullopt)
        if (t->number("transmissionFactor", 0) > 0.5f) return true;
    const auto color = pbr.numbers("baseColorFactor", 4);
    return material.text("alphaMode") == "BLEND" && color && (*color)[3] < 0.5f;
}

}  // namespace

Conductor metal_of(const glm::vec3& reflectance) {
    const glm::vec3 r = glm::min(reflectance, glm::vec3(0.9999f));
    return {.eta = glm::vec3(1), .k = 2.0f * glm::sqrt(r / (1.0f - r))};
}

ReadImage Materials::image(const Item& texture, ImageMeaning meaning, NamedMaterial& of) {
    const Coordinates coordinates = coordinates_of(texture);
    if (!of.coordinates)
        of.coordinates = coordinates;
    else if (!(*of.coordinates == coordinates))
        of.not_shown.push_back("uses several sets or transforms of coordinates; the first is used for all images");
    const ReadImage read = images_.read(texture, meaning);
    if (!read.repeats) of.not_shown.push_back("has an image that does not repeat in the file; here it does");
    return read;
}

NamedMaterial Materials::make(const std::optional<std::size_t>& index, bool by_vertices, const Item& from) {
    static const Json none = Json::object();
    NamedMaterial made;
    const Item item = index ? document_.element("materials", *index, from) : Item(none, "the default material");
    made.name = index ? name_of(item, *index) : "without material";
    const auto given = item.item("pbrMetallicRoughness");
    const Item pbr = given.value_or(Item(none, "the default material"));
    made.is_clear = is_clear(item, pbr);
    if (made.is_clear) return made;
    const auto extensions = item.item("extensions");
    const auto extension = [&](std::string_view name) { return extensions ? extensions->item(name) : std::nullopt; };
    const auto lost = [&](const char* sentence) { made.not_shown.emplace_back(sentence); };
    if (item.text("alphaMode") == "MASK" || item.text("alphaMode") == "BLEND")
        lost("is partly transparent in the file; here it is opaque everywhere");
    if (item.has("normalTexture")) lost("has a normal map, which is ignored");
    if (!given && extension("KHR_materials_pbrSpecularGlossiness"))
        lost("says its colour by specular and glossiness, which is not read; here it is a white metal");

    TintedMeshImage color{.by_vertices = by_vertices};
    glm::vec3 mean_color(1);
    if (const auto factor = pbr.numbers("baseColorFactor", 4))
        mean_color = color.factor = fraction({(*factor)[0], (*factor)[1], (*factor)[2]});
    if (const auto texture = pbr.item("baseColorTexture")) {
        const ReadImage read = image(*texture, ImageMeaning::colors, made);
        color.image = read.image;
        mean_color *= read.mean;
    }

    float metallic = std::clamp(pbr.number("metallicFactor", 1), 0.0f, 1.0f);
    const float roughness = std::clamp(pbr.number("roughnessFactor", 1), 0.0f, 1.0f);
    Number alpha = roughness * roughness;
    if (const auto texture = pbr.item("metallicRoughnessTexture")) {
        const ReadImage read = image(*texture, ImageMeaning::numbers, made);
        alpha = MeshImageNumber{
            .range = {0, roughness}, .image = read.image, .of_image = read.green, .channel = 1, .is_squared = true};
        if (metallic * (read.blue.y - read.blue.x) > 0.5f)
            lost(metallic * read.mean.z >= 0.5f ? "is partly a metal; here all of it is"
                                                : "is partly a metal; here none of it is");
        metallic *= read.mean.z;
    }

    const glm::vec3 emissive = item.vec3("emissiveFactor", glm::vec3(0));
    const auto strength = extension("KHR_materials_emissive_strength");
    const float radiance = largest(emissive) * (strength ? strength->number("emissiveStrength", 1) : 1.0f);
    TintedMeshImage light;
    bool shines = radiance > 0;
    if (const auto texture = shines ? item.item("emissiveTexture") : std::nullopt) {
        const ReadImage read = image(*texture, ImageMeaning::colors, made);
        light.image = read.image;
        shines = read.shining >= 0.5f;
        if (!shines && read.shining > 0) lost("shines in some places; here it is dark");
    }

    if (shines) {
        light.factor = fraction(emissive / largest(emissive));
        made.material = Glowing{.light = light, .radiance = radiance, .color = color};
    } else if (metallic >= 0.5f) {
        made.reflectance = mean_color;
        Conductor metal = metal_of(mean_color);
        metal.roughness = alpha;
        made.material = metal;
        if (color.image || by_vertices) lost("is a metal of several colours; here it has their mean");
    } else {
        const auto of_glass = extension("KHR_materials_ior");
        // 0 is glTF's word for a surface whose reflection other extensions say.
        const float wanted = of_glass ? of_glass->number("ior", 1.5f) : 1.5f;
        const float ior = wanted > 0 ? std::clamp(wanted, 1.01f, 4.0f) : 1.5f;
        color.internal_reflectance = CoatingAlbedo(ior, 0.0f).at(0.0f).internal().x;
        made.material = Coated{.color = color, .ior = ior, .roughness = alpha};
    }
    return made;
}

}  // namespace phasetree::tracer::gltf
