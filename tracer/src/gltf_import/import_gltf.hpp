// Converts a glTF file to a scene: clear objects become phases of a tree, everything else meshes.
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
    std::string report;                 ///< lines: the objects in their order, overlaps and gaps
};

struct ImportChoices {
    bool include_panes = false;  ///< whether closed objects of materials without volume become phases, too
    bool closes_gaps = true;     ///< whether thin gaps between clear objects are closed (closed_gaps.hpp)
};

/// Imports a .gltf or .glb file for a scene file of that name. Reads files, and writes none. Throws ParameterError for
/// "file", whose message names the file, and OutputNameError if the scene cannot name its files.
ImportedScene import_gltf(const std::filesystem::path& gltf, const std::filesystem::path& scene, const ImportChoices&);

}  // namespace phasetree::tracer::gltf_import
