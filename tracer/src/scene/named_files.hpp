// The files that a scene's text names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// The regular file that a string names, if it exists, together with the files that it references; or the images of a
/// stack, for a string such as "layer_###.png". Only readers know which strings are file names, so a string that
/// happens to name a file counts too. Files outside the permitted folder are never accessed.
std::vector<std::filesystem::path> named_files(const Document& document, Value string);

/// Calls f with `document`, then with each document that provides an object of the scene. Throws SceneError for a
/// document that cannot be read.
void each_document(const Document& document, const std::function<void(const Document&)>& f);

/// The total size in bytes of all files that a scene names, counted once per mention. If an object's file cannot be
/// read, later ones are not counted.
std::uint64_t bytes_of_named_files(const Document& document);

}  // namespace phasetree::tracer
