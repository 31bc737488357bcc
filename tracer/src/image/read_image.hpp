// Images that scenes name, read by OpenImageIO: the formats that it decodes row by row (OpenEXR, Radiance HDR, TIFF,
// PNG, JPEG, …).
//
// A file's header may claim any size. So memory is taken as rows are decoded, and a file that ends early costs no more
// than what it holds. Where the decoder takes all of the memory beforehand, the file must be long enough for what it
// claims: a PNG file, which may be interlaced, and a JPEG file, which may be progressive; of the latter the markers are
// read first, so that who wants the image can refuse its size. WebP, HEIF and JPEG 2000 are not read, because opening
// decodes them. A PNG or JPEG file that is cut off is refused.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace phasetree::tracer {

struct ImageHeader {
    int width = 0;
    int height = 0;
    int channels = 0;
    bool is_floating_point = false;
    int bits = 0;  // of a value in the file
    bool is_signed = false;
};

// `begin` gets the header before anything is decoded, once, and returns how many of the channels to read; it throws
// std::runtime_error for an image that is not wanted. `add` gets the values of some rows at a time, the top ones first;
// integers are divided by the greatest that their type can hold. Whatever is wrong with the file is std::runtime_error
// "cannot use the <what> "<path>": …".
void read_image(const std::filesystem::path& path, const std::string& what,
                const std::function<int(const ImageHeader&)>& begin,
                const std::function<void(std::span<const float>)>& add);

// The same of an image that is part of another file: all of its bytes, which must be those of a PNG or JPEG file, and a
// name for messages.
void read_image_in_memory(std::string_view bytes, const std::string& name, const std::string& what,
                          const std::function<int(const ImageHeader&)>& begin,
                          const std::function<void(std::span<const float>)>& add);

}  // namespace phasetree::tracer
