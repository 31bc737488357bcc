// Images that scenes name, read by OpenImageIO: the formats that it decodes row by row (OpenEXR, Radiance HDR, TIFF,
// PNG, JPEG, …).
//
// What is read is the display window of an OpenEXR file: pixels outside of its data window are 0 in every channel,
// alpha included, and pixels outside of its display window are cropped. Of a file with several parts the first is read.
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
    int bits = 0;  ///< of a value in the file
    bool is_signed = false;
};

/// The channels [first, first + count) of a file; a number alone means the first ones.
struct ChannelRange {
    ChannelRange(int of_first) : count(of_first) {}
    ChannelRange(int first_one, int how_many) : first(first_one), count(how_many) {}

    int first = 0;
    int count = 0;
};

/// Gets the header before anything is decoded, once, and returns which channels to read. Throws std::runtime_error for
/// an image that is not wanted.
using BeginImage = std::function<ChannelRange(const ImageHeader&)>;
/// Gets the values of some rows at a time, the top ones first; integers of any width are 0 to 1.
using AddRows = std::function<void(std::span<const float>)>;

/// Whatever is wrong with the file is std::runtime_error "cannot use the <what> "<path>": …".
void read_image(const std::filesystem::path& path, const std::string& what, const BeginImage& begin,
                const AddRows& add);

/// Reads an image that is part of another file: all of its bytes, which must be those of a PNG or JPEG file. `name` is
/// for messages.
void read_image_in_memory(std::string_view bytes, const std::string& name, const std::string& what,
                          const BeginImage& begin, const AddRows& add);

/// Reads an image whose pixels are labels. A PNG file with a palette has one channel, the indices: an index i of n bits
/// is the value i / (2ⁿ − 1). The colours of the palette only show the labels to people. Other files are read as by
/// read_image.
void read_labels(const std::filesystem::path& path, const std::string& what, const BeginImage& begin,
                 const AddRows& add);

}  // namespace phasetree::tracer
