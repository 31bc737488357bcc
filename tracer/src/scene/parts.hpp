// The readers of a scene's parts, one file each. All throw SceneError.
#pragma once

#include <string>
#include <vector>

#include "phasetree/io/object_reader.hpp"
#include "phasetree/io/range.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// Where things may be and how large: rays from farther than Embree's 1.8·10¹⁸ end the program there, and differences
// of coordinates have no digits left long before.
inline constexpr double farthest = 1e15;
inline constexpr Range coordinate{.min = -farthest, .max = farthest, .description = "from -1e15 to 1e15"};
inline constexpr Range size_of_thing{
    .min = 0, .max = farthest, .min_is_open = true, .description = "positive and at most 1e15"};

// A choice between kinds is an object of one member, {"kind": {…}}, as nodes are. Returns that member, whose key is
// one of `kinds`; `what` names the choice in messages ("a material").
Value chosen(const Document& document, Value value, std::string_view what, std::span<const std::string_view> kinds);

Material read_material(const Document& document, Value value);
// The same, but not a clear one: meshes have no inside.
Material read_opaque_material(const Document& document, Value value);
Texture read_texture(const Document& document, Value value);
Lights read_lights(const Document& document, Value root);
ThinLensParameters read_camera(const Document& document, Value value);
std::vector<Mesh> read_meshes(const Document& document, Value list);
// Image size, in the camera's parameters, and all else.
RenderSettings read_settings(const Document& document, Value value, ThinLensParameters& camera);

// The first channel of an image, as stored: integers of any width from 0 to 1, without a transfer function. Throws
// std::runtime_error.
HeightGrid read_height_grid(const std::filesystem::path&);

}  // namespace phasetree::tracer
