#include "scene/parameter_types.hpp"

#include <fmt/format.h>

#include "phasetree/io/read_kind.hpp"
#include "phasetree/io/reference.hpp"
#include "scene/read_parts.hpp"

namespace phasetree {

using TextureType = ParameterType<tracer::Texture, Parameter>;

tracer::Texture TextureType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    if (!value.is_object())
        return tracer::ConstantTexture{as_colour(document, value, "the colour", range_of(limits::fraction))};
    tracer::Texture texture;
    with_kind(tracer::SolidTextures(), document, value, "a texture", [&]<class Solid>(Value member) {
        texture = read_kind<Solid>(document, member, fmt::format("the {} texture", Solid::info.name),
                                   [](const Solid& solid) { return solid; });
    });
    return texture;
}

ValueType TextureType::describe(const Parameter&) {
    return {"colour or texture", schema_reference("texture")};
}

using FieldType = ParameterType<Field, Parameter>;

Field FieldType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    return read_field(document, value, {.height_grid = tracer::read_height_grid});
}

ValueType FieldType::describe(const Parameter&) {
    return {"field", schema_reference("field")};
}

using MaterialType = ParameterType<tracer::Material, Parameter>;

tracer::Material MaterialType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    tracer::Material material = tracer::read_material(document, value);
    if (is_clear(material))
        throw document.error(value[0].key_offset(),
                             "a mesh has no inside, so its material cannot be clear; make it a phase of the tree");
    return material;
}

ValueType MaterialType::describe(const Parameter&) {
    return {"opaque material", schema_reference("opaque_material")};
}

}  // namespace phasetree
