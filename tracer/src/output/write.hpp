// Image files on disk.
#pragma once

#include <filesystem>

#include "film/image.hpp"
#include "output/display.hpp"
#include "output/encode.hpp"
#include "output/error.hpp"

namespace phasetree::tracer {

/// Writes an image; the extension chooses the format (encode.hpp). EXR keeps the linear values as they are; for the
/// others the transform is applied. "{plane}" in the name of an EXR file makes a file for each plane, with the plane's
/// name in its place (layers.hpp); where one cannot be written, the others are. The file appears complete or not at
/// all, as any of write_file's (file.hpp). Throws OutputError; then an existing file is untouched and no temporary is
/// left.
void write_image(const Image& image, const std::filesystem::path& path, const Metadata& metadata,
                 const DisplayTransform& transform);

/// Throws the OutputError that write_image would, as far as it can be known before there is an image: to be called
/// before an hour of rendering. Leaves the directory as it was.
void check_writable(const std::filesystem::path& path);

}  // namespace phasetree::tracer
