// How parameters that are textures, materials of meshes, or whole parts of a file are read and described.
#pragma once

#include "phasetree/io/parameter_type.hpp"
#include "phasetree/model/handle.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

// A part of a scene file that has a reader of its own: its type in words, and its schema as JSON text.
struct PartParameter : Parameter {
    std::string_view type;
    std::string_view schema;
};

}  // namespace phasetree::tracer

namespace phasetree {

// A colour, or one of the solid textures.
template <>
struct ParameterType<tracer::Texture, Parameter> {
    static tracer::Texture read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::Texture&) { return "none"; }
};

// Not a clear one: meshes have no inside.
template <>
struct ParameterType<tracer::Material, Parameter> {
    static tracer::Material read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const tracer::Material&) { return "none"; }
};

// A field of the tree: a node or the name of a shape.
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
