#include "output/write.hpp"

#include <fmt/format.h>

#include "output/file.hpp"

namespace phasetree::tracer {

void write_image(const Image& image, const std::filesystem::path& path, const Metadata& metadata,
                 const DisplayTransform& transform) {
    const Format format = format_of(path);
    check_file_writable(path);  // first, so that what is said is the same before and after rendering
    std::vector<unsigned char> bytes;
    try {
        bytes = encode(image, format, metadata, transform);
    } catch (const OutputError& error) {
        throw OutputError(fmt::format("cannot write \"{}\": {}", path.string(), error.what()));
    }
    write_file(bytes, path);
}

void check_writable(const std::filesystem::path& path) {
    format_of(path);
    check_file_writable(path);
}

}  // namespace phasetree::tracer
