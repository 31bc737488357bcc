// What the markers of a JPEG file say (ITU-T T.81, annex B), without decoding anything: OpenImageIO decodes all scans
// of a file that has several when it opens it, whatever size it claims.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace phasetree::tracer {

struct JpegHeader {
    int width = 0;
    int height = 0;
    int components = 0;
    int bits = 0;  // of a value
    bool is_progressive = false;
    int scans = 0;
    std::uint64_t least_bytes = 0;  // that a file of this size can have
};

// Returns the next bytes of a file, as many as it likes; none at its end.
using NextBytes = std::function<std::string_view()>;

// Reads from the first marker to the last one. Bytes behind that do not matter. Throws std::runtime_error for a file
// that ends before it, has no image, or has more than a hundred scans: ten or so are usual, and each may be short and
// take as long as the image is large.
JpegHeader read_jpeg_header(const NextBytes&);

}  // namespace phasetree::tracer
