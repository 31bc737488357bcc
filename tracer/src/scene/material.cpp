#include <fmt/format.h>

#include <cmath>

#include "phasetree/io/suggest.hpp"
#include "scene/parts.hpp"
#include "shading/metals.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::string_view kinds[] = {"clear", "diffuse", "conductor", "coated"};

float roughness(ObjectReader& reader) {
    return reader.optional("roughness", 0.0f, Range::between(0, 1));
}

// Absorption per unit length: itself, or as the colour that is left of white light after a distance.
Clear read_clear(ObjectReader& reader) {
    Clear clear;
    clear.ior = reader.required<float>("ior", Range::between(0.1, 10));
    AbsorbingMedium medium;
    medium.absorption = reader.optional("absorption", medium.absorption, Range::not_negative());
    const std::optional<Value> color = reader.value("color");
    const float distance = reader.optional("color_distance", 1.0f, Range::positive());
    if (color) {
        if (reader.value("absorption"))
            throw reader.document().error(color->key_offset(),
                                          "\"color\" and \"absorption\" say the same; give one of them");
        const glm::vec3 c =
            as_colour(reader.document(), *color, "\"color\"", Range{.min = 0, .max = 1, .min_is_open = true});
        for (int i = 0; i < 3; ++i) medium.absorption[i] = std::max(0.0f, -std::log(c[i]) / distance);
    }
    clear.interior = medium;
    clear.roughness = roughness(reader);
    return clear;
}

Conductor read_conductor(ObjectReader& reader) {
    Conductor conductor;
    if (const std::optional<Value> name = reader.value("metal")) {
        reader.allow({"eta", "k"});
        if (reader.value("eta") || reader.value("k"))
            throw reader.document().error(name->key_offset(),
                                          "\"metal\" names \"eta\" and \"k\"; give either the one or the others");
        const std::string metal = as<std::string>(reader.document(), *name, "\"metal\"");
        const std::optional<Metal> found = find_metal(metal);
        if (!found) {
            std::vector<std::string_view> names;
            for (const Metal& m : metals()) names.push_back(m.name);
            throw reader.document().error(
                *name, fmt::format("no metal \"{}\" is known; there are {}", metal, fmt::join(names, ", ")),
                closest(metal, names));
        }
        conductor.eta = found->eta;
        conductor.k = found->k;
    } else {
        conductor.eta = reader.required<glm::vec3>("eta", Range::positive());
        conductor.k = reader.required<glm::vec3>("k", Range::not_negative());
    }
    conductor.roughness = roughness(reader);
    return conductor;
}

}  // namespace

Material read_material(const Document& document, Value value) {
    const Value member = chosen(document, value, "a material", kinds);
    const std::string_view kind = member.key();
    ObjectReader reader(document, member, fmt::format("the {} material", kind));
    Material material;
    if (kind == "clear") {
        material = read_clear(reader);
    } else if (kind == "diffuse") {
        material = Diffuse{read_texture(document, reader.required_value("color"))};
    } else if (kind == "conductor") {
        material = read_conductor(reader);
    } else {
        Coated coated;
        coated.color = read_texture(document, reader.required_value("color"));
        coated.ior = reader.optional("ior", coated.ior, Range::between(1, 4));
        coated.roughness = roughness(reader);
        material = coated;
    }
    reader.finish();
    return material;
}

Material read_opaque_material(const Document& document, Value value) {
    Material material = read_material(document, value);
    if (is_clear(material))
        throw document.error(value[0].key_offset(),
                             "a mesh has no inside, so its material cannot be clear; make it a phase of the tree");
    return material;
}

}  // namespace phasetree::tracer
