// Image files on disk.
#pragma once

#include <filesystem>
#include <optional>

#include "film/image.hpp"
#include "output/display.hpp"
#include "output/encode.hpp"
#include "output/error.hpp"

namespace phasetree::tracer {

/// Whether files of this name hold what a display shows, so that write_image needs a transform for them. EXR keeps the
/// linear values as they are. Throws OutputError as format_of does.
inline bool needs_display(const std::filesystem::path& path) {
    return format_of(path) != Format::exr;
}

/// Writes an image; the extension chooses the format (encode.hpp). The transform may be empty unless needs_display.
/// "{plane}" in the name of an EXR file makes a file for each plane, with the plane's name in its place (layers.hpp).
/// If one of these cannot be written, the others still are. The file appears complete or not at all, like any file of
/// write_file (file.hpp). Throws OutputError; then an existing file is untouched and no temporary is left.
void write_image(const Image& image, const std::filesystem::path& path, const Metadata& metadata,
                 const std::optional<DisplayTransform>& transform);

/// Throws the OutputError that write_image would, as far as it can be known before there is an image: to be called
/// before an hour of rendering. Leaves the directory as it was.
void check_writable(const std::filesystem::path& path);

}  // namespace phasetree::tracer
