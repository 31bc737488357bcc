#include "scene/parts.hpp"

namespace phasetree::tracer {

// A colour by itself, or {"wood": {…}}, {"speckle": {…}}, {"marble": {…}}, {"checker": {…}}.
Texture read_texture(const Document& document, Value value) {
    if (!value.is_object()) return ConstantTexture{as_colour(document, value, "the colour", Range::between(0, 1))};
    static constexpr std::string_view kinds[] = {"wood", "speckle", "marble", "checker"};
    const Value member = chosen(document, value, "a texture", kinds);
    const std::string kind(member.key());
    ObjectReader reader(document, member, "the " + kind + " texture");
    const auto colour = [&](std::string_view key, const glm::vec3& fallback) {
        return reader.optional_colour(key, fallback, Range::between(0, 1));
    };
    Texture texture;
    if (kind == "wood") {
        WoodTexture t;
        t.light = colour("light", t.light);
        t.dark = colour("dark", t.dark);
        t.ring_spacing = reader.optional("ring_spacing", t.ring_spacing, Range::positive());
        t.axis = reader.optional("axis", t.axis);
        t.pith = reader.optional("pith", t.pith);
        t.seed = reader.optional("seed", t.seed);
        if (!(glm::length(t.axis) > 0)) throw document.error(*reader.value("axis"), "\"axis\" has no direction");
        texture = t;
    } else if (kind == "speckle") {
        SpeckleTexture t;
        t.color = colour("color", t.color);
        t.other = colour("other", t.other);
        t.grain = reader.optional("grain", t.grain, Range::positive());
        t.contrast = reader.optional("contrast", t.contrast, Range::between(0, 1));
        t.seed = reader.optional("seed", t.seed);
        texture = t;
    } else if (kind == "marble") {
        MarbleTexture t;
        t.color = colour("color", t.color);
        t.vein = colour("vein", t.vein);
        t.scale = reader.optional("scale", t.scale, Range::positive());
        t.seed = reader.optional("seed", t.seed);
        texture = t;
    } else {
        CheckerTexture t;
        t.even = colour("even", t.even);
        t.odd = colour("odd", t.odd);
        t.size = reader.optional("size", t.size, Range::positive());
        t.origin = reader.optional("origin", t.origin);
        texture = t;
    }
    reader.finish();
    return texture;
}

}  // namespace phasetree::tracer
