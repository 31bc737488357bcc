// Reads the markers of a JPEG file (ITU-T T.81, annex B) without decoding anything. OpenImageIO decodes all scans of a
// multi-scan file when it opens it, whatever size the file claims.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace phasetree::tracer {

struct JpegHeader {
    int width = 0;
    int height = 0;
    int components = 0;
    int bits = 0;  // per value
    bool is_progressive = false;
    int scans = 0;
    std::uint64_t least_bytes = 0;  // lower bound on the size of a file with this header
};

// Returns the next chunk of a file, of any length; empty at the end.
using NextBytes = std::function<std::string_view()>;

// Reads from the first marker to the last; bytes after it are ignored. Throws std::runtime_error for a file that ends
// early, has no image, or has more than a hundred scans. Ten or so are usual, and decoding even a short scan may take
// time proportional to the image size.
JpegHeader read_jpeg_header(const NextBytes&);

}  // namespace phasetree::tracer
