// Images that scenes name, read by OpenImageIO: the formats that it decodes row by row (OpenEXR, Radiance HDR, TIFF,
// PNG, JPEG, …).
//
// OpenEXR files are read by their display window: pixels outside of the data window are 0 in every channel, alpha
// included, and pixels outside of the display window are cropped. If a file has several parts, only the first is read.
// Other formats have no display window, and their pixels are read as stored, whatever orientation their metadata name.
// A TIFF file that says it is part of a larger picture is rejected.
//
// Floating-point values must be finite. An infinite or undefined number has no meaning as light, colour, mask or
// height, and one such pixel can spoil a whole picture, so the file is rejected with the number of these pixels and the
// first.
//
// A file's header may claim any size. Memory is therefore taken as rows are decoded, so a file that ends early costs no
// more than what it holds. Some decoders take all of the memory beforehand; their files must be long enough for what
// they claim. These are PNG, which may be interlaced, and JPEG, which may be progressive; the markers of a JPEG file
// are read first, so that the caller can reject its size. WebP, HEIF and JPEG 2000 are not read, because opening
// decodes them. A PNG or JPEG file that is cut off is rejected.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace phasetree::tracer {

struct ImageHeader {
    int width = 0;  ///< of the display window
    int height = 0;
    int channels = 0;
    bool is_floating_point = false;
    int bits = 0;  ///< per value in the file
    bool is_signed = false;
};

/// The channels [first, first + count) of a file. A number alone means the first `count` channels.
struct ChannelRange {
    ChannelRange(int of_first) : count(of_first) {}
    ChannelRange(int first_one, int how_many) : first(first_one), count(how_many) {}

    int first = 0;
    int count = 0;
};

/// Called once with the header, before anything is decoded. Returns the channels to read. Throws std::runtime_error to
/// reject the image.
using BeginImage = std::function<ChannelRange(const ImageHeader&)>;
/// Called with the values of a few rows at a time, from the top. Integers of any width are scaled to [0, 1].
using AddRows = std::function<void(std::span<const float>)>;

/// Any problem with the file throws std::runtime_error "cannot use the <what> "<path>": …".
void read_image(const std::filesystem::path& path, const std::string& what, const BeginImage& begin,
                const AddRows& add);

/// Reads an image embedded in another file from all of its bytes, which must be a PNG or JPEG file. `name` is used in
/// messages.
void read_image_in_memory(std::string_view bytes, const std::string& name, const std::string& what,
                          const BeginImage& begin, const AddRows& add);

/// Reads an image whose pixels are labels. A PNG file with a palette has one channel, its indices: an index i of n bits
/// becomes the value i / (2ⁿ − 1). The colours of the palette are only for viewing. Other files are read as by
/// read_image.
void read_labels(const std::filesystem::path& path, const std::string& what, const BeginImage& begin,
                 const AddRows& add);

}  // namespace phasetree::tracer
