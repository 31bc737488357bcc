// Reading and description of parameters that are textures, materials of meshes, or whole parts of a file.
#pragma once

#include "phasetree/io/parameter_type.hpp"
#include "phasetree/model/handle.hpp"
#include "scene/voxels.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

// A part of a scene file with its own reader: its type in words, and its schema as JSON text.
struct PartParameter : Parameter {
    std::string_view type;
    std::string_view schema;
};

// Blackbody emission, as described in a scene file.
struct BlackbodyParameters {
    static constexpr KindInfo info{"blackbody", "The spectrum of a black body."};

    float temperature = 6500.0f;

    template <class V>
    static void parameters(V&& v) {
        v(&BlackbodyParameters::temperature,
          Parameter{"blackbody", "K", "Temperature: 1,900 for a candle, 2,700 for a light bulb.",
                    Limits{.low = 500, .high = 100000}});
    }
};

}  // namespace phasetree::tracer

namespace phasetree {

// A colour or a texture.
template <>
struct ParameterType<tracer::Texture, Parameter> {
    static tracer::Texture read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::Texture&) { return "none"; }
};

// The stops of a ramp.
template <>
struct ParameterType<tracer::TextureRamp, tracer::RampParameter> {
    static tracer::TextureRamp read(const Document&, Value, std::string_view what, const tracer::RampParameter&);
    static ValueType describe(const tracer::RampParameter&);
    static std::string written(const tracer::TextureRamp&) { return "none"; }
};
template <>
struct ParameterType<std::vector<tracer::NumberStop>, tracer::RampParameter> {
    static std::vector<tracer::NumberStop> read(const Document&, Value, std::string_view what,
                                                const tracer::RampParameter&);
    static ValueType describe(const tracer::RampParameter&);
    static std::string written(const std::vector<tracer::NumberStop>&) { return "none"; }
};

// The points of a spectrum.
template <>
struct ParameterType<tracer::SharedSpectrum, tracer::SpectrumParameter> {
    static tracer::SharedSpectrum read(const Document&, Value, std::string_view what, const tracer::SpectrumParameter&);
    static ValueType describe(const tracer::SpectrumParameter&);
    static std::string written(const tracer::SharedSpectrum&) { return "none"; }
};

// The spectrum of a light: points, or {"blackbody": temperature}.
template <>
struct ParameterType<tracer::SharedLightSpectrum, Parameter> {
    static tracer::SharedLightSpectrum read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::SharedLightSpectrum&) { return "none"; }
};

// A constant number, or one that depends on a field. The limits apply to each of its values.
template <>
struct ParameterType<tracer::Number, Parameter> {
    static tracer::Number read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::Number& number) {
        const float* constant = std::get_if<float>(&number);
        return constant ? ParameterType<float, Parameter>::written(*constant) : "none";
    }
};

// Reads the image.
template <>
struct ParameterType<tracer::NormalMap, Parameter> {
    static tracer::NormalMap read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::NormalMap&) { return "none"; }
};

// Reads the file.
template <>
struct ParameterType<tracer::Voxels, Parameter> {
    static tracer::Voxels read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::Voxels&) { return "none"; }
};

// Clear materials are excluded, because meshes have no interior.
template <>
struct ParameterType<tracer::Material, Parameter> {
    static tracer::Material read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::Material&) { return "none"; }
};

// How a medium scatters.
template <>
struct ParameterType<tracer::PhaseFunction, Parameter> {
    static tracer::PhaseFunction read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::PhaseFunction&) { return "none"; }
};

// A field of the tree: a node, or the name of a shape.
template <>
struct ParameterType<Field, Parameter> {
    static Field read(const Document&, Value value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const Field&) { return "none"; }
};

template <>
struct ParameterType<Value, tracer::PartParameter> {
    static Value read(const Document&, Value value, std::string_view, const tracer::PartParameter&) { return value; }
    static ValueType describe(const tracer::PartParameter& p) { return {std::string(p.type), std::string(p.schema)}; }
    static std::string written(const Value&) { return "none"; }
};

}  // namespace phasetree
