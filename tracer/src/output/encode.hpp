// Encodes image files in memory with OpenImageIO. This way our own code writes the bytes and detects a full disk; some
// libraries used by OpenImageIO end the program instead.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "film/image.hpp"
#include "output/display.hpp"
#include "output/layers.hpp"
#include "phasetree/version.hpp"

namespace phasetree::tracer {

/// How a picture was made. Equal pictures must give equal files, so times, dates and thread counts must not be added.
struct Metadata {
    std::string scene;  ///< the scene's file name without its folder
    int samples_per_pixel = 0;
    std::uint64_t seed = 0;
    std::string build = build_id();  ///< the phasetree build that rendered the picture
};

enum class Format { exr, png, jpeg, tiff };

/// The format for a file name's extension, ignoring case. Throws OutputNameError, which lists the formats.
Format format_of(const std::filesystem::path& path);

/// Returns the bytes of the file. Equal arguments give equal bytes.
///   EXR   scene-linear 32-bit float RGB and all other channels under their names, ZIP-compressed; the transform is not
///         applied. Attributes: phasetree:scene, phasetree:samplesPerPixel, phasetree:seed (as text, because EXR has no
///         64-bit integers), Software, chromaticities.
///   PNG   8 bits, dithered (quantise.hpp), tagged sRGB if the display is.
///   JPEG  the same 8 bits and tag, quality 95, chroma not subsampled.
///   TIFF  16 bits, ZIP-compressed.
/// If the image has a channel "A" and a black background, which is recognised by pixels without coverage, PNG and TIFF
/// store it as a fourth channel. Their colours are divided by it, as these formats expect. Throws OutputError with the
/// reason, without the path.
std::vector<unsigned char> encode(const Image& image, Format format, const Metadata& metadata,
                                  const DisplayTransform& transform);

/// Encodes a PNG file from display values: red, green and blue, row by row. Throws as encode() does.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> pixels, int width, int height,
                                      const std::string& description);

/// Encodes an EXR file with a single layer (layers.hpp). Throws as encode() does.
std::vector<unsigned char> encode_layer(const Image& image, const Layer& layer, const Metadata& metadata);

/// OpenImageIO's version.
std::string openimageio_version();

}  // namespace phasetree::tracer
