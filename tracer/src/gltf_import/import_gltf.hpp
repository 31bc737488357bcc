// Converts a glTF file to a scene: clear objects become phases of a tree; everything else becomes meshes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phasetree::tracer::gltf_import {

struct ImportedMesh {
    std::string file;   ///< relative to the folder of the scene
    std::string bytes;  ///< a PLY file
};

struct ImportedScene {
    std::string text;                   ///< of the scene file
    std::vector<ImportedMesh> meshes;   ///< files that the scene names
    std::vector<std::string> warnings;  ///< sentences about what is lost
    /// Text lines: the objects in order of precedence (precedence.hpp), numbered from 1, then their overlaps and gaps.
    std::string report;
};

struct ImportChoices {
    /// Whether closed objects become phases even if their clear material lacks KHR_materials_volume. By default, they
    /// become panes of thin_glass.
    bool include_panes = false;
    bool closes_gaps = true;  ///< whether thin gaps between clear objects are closed (closed_gaps.hpp)
};

/// Imports a .gltf or .glb file. `scene` is the path at which the scene is to be saved; paths in its text are relative
/// to it. Reads files, and writes none. Throws ParameterError (for the parameter "file") if the file cannot be
/// imported, and OutputNameError if a path is not UTF-8, which a scene file cannot contain.
ImportedScene import_gltf(const std::filesystem::path& gltf, const std::filesystem::path& scene, const ImportChoices&);

}  // namespace phasetree::tracer::gltf_import
