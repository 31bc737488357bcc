#include "scene/parameter_types.hpp"

#include <fmt/format.h>

#include "phasetree/io/keys.hpp"
#include "phasetree/io/read_kind.hpp"
#include "phasetree/io/reference.hpp"
#include "scene/phase_function_kinds.hpp"
#include "scene/read_parts.hpp"
#include "scene/unread_file.hpp"

namespace phasetree {

namespace {

// Prepares a texture, map or voxels for evaluation, unless this would open a file that the document must not open.
template <class Kind>
Kind prepared(const Document& document, Kind kind) {
    if constexpr (requires { kind.prepare(); }) {
        if (tracer::is_left_unread(document, kind)) return kind;
        try {
            kind.prepare();
        } catch (const ModelError& e) {
            throw ParameterError("of", e.what());
        }
    }
    return kind;
}

template <class Kind>
Kind read_prepared(const Document& document, Value value, std::string_view what) {
    return read_kind<Kind>(document, value, what, [&](Kind kind) { return prepared(document, std::move(kind)); });
}

// Calls add(at, value) for each stop of a ramp.
template <class Add>
void read_ramp(const Document& document, Value list, std::string_view what, const Add& add) {
    if (!list.is_array() || list.size() == 0)
        throw document.error(list, fmt::format("{} must be a list of stops, [[value, …], …]", what));
    std::optional<float> last;
    for (const Value stop : list) {
        if (!stop.is_array() || stop.size() != 2)
            throw document.error(stop, fmt::format("a stop of {} must be [value of the field, result]", what));
        const float at = as<float>(document, stop[0], "the value of a stop");
        if (last && !(at >= *last))
            throw document.error(stop[0],
                                 fmt::format("the values of {} must increase, but {} follows {}", what, at, *last));
        last = at;
        add(at, stop[1]);
    }
}

std::string schema_of_ramp(const std::string& item) {
    return R"({"type": "array", "minItems": 1, "items": {"type": "array", "minItems": 2, "maxItems": 2, "items": [)"
           R"({"type": "number"}, )" +
           item + "]}}";
}

}  // namespace

using TextureType = ParameterType<tracer::Texture, Parameter>;

tracer::Texture TextureType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    if (!value.is_object() || Keys::are_in(value))
        return tracer::ConstantTexture{as_colour(document, value, "the colour", range_of(limits::fraction))};
    tracer::Texture texture;
    with_kind(tracer::NamedTextures(), document, value, "a texture", [&]<class Kind>(Value member) {
        texture = read_prepared<Kind>(document, member, fmt::format("the {} texture", Kind::info.name));
    });
    return texture;
}

ValueType TextureType::describe(const Parameter&) {
    return {"colour or texture", schema_reference("texture")};
}

using TextureRampType = ParameterType<tracer::TextureRamp, tracer::RampParameter>;

tracer::TextureRamp TextureRampType::read(const Document& document, Value value, std::string_view what,
                                          const tracer::RampParameter& p) {
    std::vector<tracer::TextureStop> stops;
    read_ramp(document, value, what, [&](float at, Value colour) {
        stops.push_back({at, TextureType::read(document, colour, what, p)});
    });
    return std::make_shared<const std::vector<tracer::TextureStop>>(std::move(stops));
}

ValueType TextureRampType::describe(const tracer::RampParameter&) {
    return {"list of [number, colour or texture]", schema_of_ramp(schema_reference("texture"))};
}

using SpectrumType = ParameterType<tracer::SharedSpectrum, tracer::SpectrumParameter>;

tracer::SharedSpectrum SpectrumType::read(const Document& document, Value value, std::string_view what,
                                          const tracer::SpectrumParameter& p) {
    if (!value.is_array() || value.size() == 0)
        throw document.error(value, fmt::format("{} must be a list of points, [[wavelength, value], …]", what));
    std::vector<tracer::Spectrum::Point> points;
    for (const Value point : value) {
        if (!point.is_array() || point.size() != 2)
            throw document.error(point, fmt::format("a point of {} must be [wavelength in nanometres, value]", what));
        const float nanometres = as<float>(document, point[0], "the wavelength of a point", range_of(limits::positive));
        if (!points.empty() && !(nanometres > points.back().nanometres))
            throw document.error(point[0], fmt::format("the wavelengths of {} must increase, but {} follows {}", what,
                                                       nanometres, points.back().nanometres));
        points.push_back({nanometres, as<float>(document, point[1], "the value of a point", range_of(p.limits))});
    }
    if (points.back().nanometres < 380.0f || points.front().nanometres > 780.0f)
        throw document.error(
            value, fmt::format("{} has no visible wavelength; visible light ranges from 380 to 780 nanometres", what));
    return std::make_shared<const tracer::Spectrum>(std::move(points));
}

ValueType SpectrumType::describe(const tracer::SpectrumParameter&) {
    return {"list of [nm, number]", schema_of_ramp(R"({"type": "number"})")};
}

using LightSpectrumType = ParameterType<tracer::SharedLightSpectrum, Parameter>;

tracer::SharedLightSpectrum LightSpectrumType::read(const Document& document, Value value, std::string_view what,
                                                    const Parameter& p) {
    if (value.is_object())
        return read_kind<tracer::BlackbodyParameters>(document, value, what, [](const auto& blackbody) {
            return std::make_shared<const tracer::LightSpectrum>(
                tracer::LightSpectrum::of_temperature(blackbody.temperature));
        });
    if (!value.is_array())
        throw document.error(value, fmt::format("{} must be a list of points, [[wavelength, value], …], or "
                                                "{{\"blackbody\": kelvin}}",
                                                what));
    const tracer::SharedSpectrum power =
        SpectrumType::read(document, value, what, tracer::SpectrumParameter{{p.name, "", "", limits::non_negative}});
    auto spectrum = std::make_shared<const tracer::LightSpectrum>(*power);
    if (!spectrum->visible())
        throw document.error(value,
                             fmt::format("{} is 0 everywhere from 380 to 780 nm, so there would be no light", what));
    return spectrum;
}

ValueType LightSpectrumType::describe(const Parameter&) {
    return {"list of [nm, number], or {\"blackbody\": kelvin}",
            schema_of_either(schema_of_ramp(R"({"type": "number"})"),
                             R"({"type": "object", "required": ["blackbody"], "additionalProperties": false,
                                 "properties": {"blackbody": {"type": "number", "minimum": 500, "maximum": 100000}}})")};
}

using NumberRampType = ParameterType<std::vector<tracer::NumberStop>, tracer::RampParameter>;

std::vector<tracer::NumberStop> NumberRampType::read(const Document& document, Value value, std::string_view what,
                                                     const tracer::RampParameter&) {
    std::vector<tracer::NumberStop> stops;
    read_ramp(document, value, what, [&](float at, Value number) {
        stops.push_back({at, as<float>(document, number, "the number of a stop")});
    });
    return stops;
}

ValueType NumberRampType::describe(const tracer::RampParameter&) {
    return {"list of [number, number]", schema_of_ramp(R"({"type": "number"})")};
}

using NumberType = ParameterType<tracer::Number, Parameter>;

tracer::Number NumberType::read(const Document& document, Value value, std::string_view what, const Parameter& p) {
    if (!value.is_object() || Keys::are_in(value)) return as<float>(document, value, what, range_of(p.limits));
    tracer::Number number;
    with_kind(tracer::NumberTextures(), document, value, what, [&]<class Kind>(Value member) {
        number = read_kind<Kind>(document, member, fmt::format("the {} of {}", Kind::info.name, what), [&](Kind kind) {
            constexpr std::string_view values = requires {
                kind.ramp;
            }
            ? "ramp" : "range";
            for (const float end : {kind.least(), kind.greatest()})
                if (!p.limits.contains(end))
                    throw ParameterError(std::string(values),
                                         fmt::format("{} must be {}, but the {} has {}", what,
                                                     phasetree::describe(range_of(p.limits)), values, end));
            return prepared(document, std::move(kind));
        });
    });
    return number;
}

ValueType NumberType::describe(const Parameter& p) {
    return {"number or field",
            schema_of_either(ParameterType<float, Parameter>::describe(p).schema, schema_reference("number_texture"))};
}

using NormalMapType = ParameterType<tracer::NormalMap, Parameter>;

tracer::NormalMap NormalMapType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    return read_prepared<tracer::NormalMap>(document, value, "the normal map");
}

ValueType NormalMapType::describe(const Parameter&) {
    return {"normal map", schema_reference("normal_map")};
}

using VoxelsType = ParameterType<tracer::Voxels, Parameter>;

tracer::Voxels VoxelsType::read(const Document& document, Value value, std::string_view what, const Parameter&) {
    return read_prepared<tracer::Voxels>(document, value, what);
}

ValueType VoxelsType::describe(const Parameter&) {
    return {"voxels", schema_reference("voxels")};
}

using PhaseFunctionType = ParameterType<tracer::PhaseFunction, Parameter>;

tracer::PhaseFunction PhaseFunctionType::read(const Document& document, Value value, std::string_view,
                                              const Parameter&) {
    tracer::PhaseFunction phase;
    with_kind(tracer::PhaseFunctionKinds(), document, value, "a phase function", [&]<class Kind>(Value member) {
        phase = read_kind<Kind>(document, member, fmt::format("the {} phase function", Kind::info.name),
                                [](const Kind& kind) { return kind.made(); });
    });
    return phase;
}

ValueType PhaseFunctionType::describe(const Parameter&) {
    return {"phase function", schema_reference("phase_function")};
}

using FieldType = ParameterType<Field, Parameter>;

Field FieldType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    return read_field(document, value, tracer::file_readers());
}

ValueType FieldType::describe(const Parameter&) {
    return {"field", schema_reference("field")};
}

using MaterialType = ParameterType<tracer::Material, Parameter>;

tracer::Material MaterialType::read(const Document& document, Value value, std::string_view, const Parameter&) {
    tracer::Material material = tracer::read_material(document, value);
    if (is_clear(material))
        throw document.error(
            value[0].key_offset(),
            "meshes and mixes cannot be clear, because they have no interior; use a phase of the tree instead, or "
            "\"thin_glass\" for a window pane");
    return material;
}

ValueType MaterialType::describe(const Parameter&) {
    return {"opaque material", schema_reference("opaque_material")};
}

}  // namespace phasetree
