// The files that a scene's text names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// The regular file that a string names, if there is one, and those that it names itself; and the images of the stack
/// that a string such as "layer_###.png" names. Which strings name files only their readers know: one that is a file's
/// name by chance counts, too. No file that lies outside of the folder that files must lie in is asked for.
std::vector<std::filesystem::path> named_files(const Document& document, Value string);

/// Calls f with each document from which a scene takes an object, after `document` itself. Throws SceneError for one
/// that cannot be read.
void each_document(const Document& document, const std::function<void(const Document&)>& f);

/// How many bytes all files have that a scene names, each as often as it is named; where an object's file cannot be
/// read, without those behind it.
std::uint64_t bytes_of_named_files(const Document& document);

}  // namespace phasetree::tracer
