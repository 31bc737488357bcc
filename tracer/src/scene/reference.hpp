// The reference of scene files: the library's nodes, and the path tracer's lists of parameters.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/reference.hpp"

namespace phasetree::tracer {

// The chapter on "expect", whose statements have no picture.
inline constexpr std::string_view chapter_without_pictures = "Statements";

std::vector<Chapter> scene_chapters();

// The names of the kinds of materials that meshes can have but phases cannot.
std::vector<std::string_view> materials_for_meshes_only();

// For a terminal.
std::string scene_reference_text();

struct ReferencePage {
    std::string file;  // such as "lights.md"
    std::string text;  // in Markdown
};

// The pages of scenes/reference: one per chapter, and the index, README.md. The examples of kinds, except nodes, are
// read from `folder`, such as lights/sun.json; throws std::runtime_error if one is missing.
std::vector<ReferencePage> scene_reference_pages(const std::filesystem::path& folder);

// The JSON Schema of scene files, scenes/scene.schema.json.
std::string scene_json_schema();

}  // namespace phasetree::tracer
