// Image files as bytes in memory, by OpenImageIO. In memory, because a full disk then shows where we write the bytes
// ourselves; some of the libraries beneath OpenImageIO end the program there.
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

/// How a picture was made. Equal pictures must be equal files: times, dates and thread counts have no place here.
struct Metadata {
    std::string scene;  ///< the scene's file name; its folder is left out
    int samples_per_pixel = 0;
    std::uint64_t seed = 0;
    std::string build = build_id();  ///< of phasetree, which rendered the picture
};

enum class Format { exr, png, jpeg, tiff };

/// The format a file name's extension stands for, in either case. Throws OutputError, naming the formats.
Format format_of(const std::filesystem::path& path);

/// The file's bytes; equal arguments give equal bytes.
///   EXR   scene-linear 32-bit float RGB, and the further channels under their names, ZIP; the transform is not
///   applied. Attributes phasetree:scene,
///         phasetree:samplesPerPixel, phasetree:seed (as text: EXR has no 64-bit integers), Software, chromaticities.
///   PNG   8 bits, dithered (quantise.hpp), tagged sRGB where the display is
///   JPEG  the same 8 bits and tag, quality 95, chroma not subsampled
///   TIFF  16 bits, ZIP
/// With a channel "A" and a black background, which is known by pixels that nothing covers, PNG and TIFF have it as a
/// fourth channel, and colours are divided by it first, as such files have them.
/// Throws OutputError with the reason, not knowing the path.
std::vector<unsigned char> encode(const Image& image, Format format, const Metadata& metadata,
                                  const DisplayTransform& transform);

/// A PNG file of pixels that are as a display shows them: red, green and blue, row by row. Throws as encode() does.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> pixels, int width, int height,
                                      const std::string& description);

/// The same of an EXR file that has one layer alone (layers.hpp).
std::vector<unsigned char> encode_layer(const Image& image, const Layer& layer, const Metadata& metadata);

/// OpenImageIO's version.
std::string openimageio_version();

}  // namespace phasetree::tracer
