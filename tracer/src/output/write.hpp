// Image files on disk.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "film/image.hpp"
#include "output/display.hpp"
#include "output/encode.hpp"
#include "output/error.hpp"

namespace phasetree::tracer {

/// Whether a file with this name stores display values, so that write_image needs a transform. EXR stores linear
/// values. Throws OutputNameError as format_of does.
inline bool needs_display(const std::filesystem::path& path) {
    return format_of(path) != Format::exr;
}

/// Writes an image in the format given by the extension (encode.hpp). The transform may be empty unless needs_display.
/// "{plane}" in the name of an EXR file stands for the plane's name, and writes one file per plane (layers.hpp); if one
/// of them fails, the others are still written. Each file appears complete or not at all, as with write_file
/// (file.hpp). Throws OutputError, leaving an existing file unchanged and no temporary file.
void write_image(const Image& image, const std::filesystem::path& path, const Metadata& metadata,
                 const std::optional<DisplayTransform>& transform);

/// Throws the OutputError that write_image would, as far as it can be predicted, for an image with these layers besides
/// the picture (layer_names). Call this before a long render. Leaves the directory unchanged.
void check_writable(const std::filesystem::path& path, std::span<const std::string> layers = {});

}  // namespace phasetree::tracer
