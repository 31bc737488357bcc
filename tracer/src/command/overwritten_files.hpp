// Protects files from being overwritten by a command that also reads or writes them under another option.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "command/scene_file.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

// A file of a command line, and the option that names it, such as "--stats" or "the scene".
struct NamedFile {
    std::string option;
    std::filesystem::path path;
};

// Whether two paths lead to the same file, which need not exist yet. Follows symbolic links, and recognises hard links.
// Returns false for devices and pipes, which keep nothing that could be lost.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

// Throws UsageError if an output is one of the inputs, or if two outputs are the same file. An output with {plane} in
// its name stands for the files of all planes.
void check_overwrites(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

// As above for outputs of a command that reads a scene: its inputs are the scene, and all files that the scene names.
// Throws SceneError if an object's file cannot be read.
void check_overwrites(const SceneFile& scene, const Document& document, std::span<const NamedFile> outputs);

// The same option for several files.
std::vector<NamedFile> named_files_of(const std::string& option, std::span<const std::string> paths);

}  // namespace phasetree::tracer
