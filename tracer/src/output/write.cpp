#include "output/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "output/file.hpp"

namespace phasetree::tracer {

namespace {

// Writes the result of `encoding` to a file.
template <class Encoding>
void write_encoded(const std::filesystem::path& path, Encoding&& encoding) {
    check_file_writable(path);  // first, so that errors are the same before and after rendering
    std::vector<unsigned char> bytes;
    try {
        bytes = encoding();
    } catch (const OutputError& error) {
        throw OutputError(fmt::format("cannot write \"{}\": {}", path.string(), error.what()));
    }
    write_file(bytes, path);
}

// If one file fails, the others are still written.
void write_layers(const Image& image, const std::filesystem::path& path, const Metadata& metadata) {
    std::optional<OutputError> first_error;
    std::vector<Layer> layers = layers_of(image);
    // The picture is the first layer. Write it last, so that if its file exists, so do the others.
    std::rotate(layers.begin(), layers.begin() + 1, layers.end());
    for (const Layer& layer : layers) try {
            write_encoded(file_of_plane(path, layer.name), [&] { return encode_layer(image, layer, metadata); });
        } catch (const OutputError& error) {
            if (!first_error) first_error = error;
        }
    if (first_error) throw *first_error;
}

// Returns the format. Throws OutputNameError if the name asks for something impossible.
Format checked_format(const std::filesystem::path& path) {
    const Format format = format_of(path);
    if (!is_for_each_plane(path)) return format;
    const auto refusal = [&](const char* why) {
        return OutputNameError(fmt::format("cannot write \"{}\": {}", path.string(), why));
    };
    if (format != Format::exr) throw refusal("{plane} requires an .exr file; other formats have no planes");
    if (is_for_each_plane(path.parent_path()))
        throw refusal("{plane} is allowed in the file name only, not in the name of a folder");
    return format;
}

}  // namespace

void write_image(const Image& image, const std::filesystem::path& path, const Metadata& metadata,
                 const std::optional<DisplayTransform>& transform) {
    const Format format = checked_format(path);
    if (is_for_each_plane(path)) return write_layers(image, path, metadata);
    write_encoded(path, [&] {
        if (format == Format::exr) return encode_layer(image, whole(image), metadata);
        return encode(image, format, metadata, transform.value());
    });
}

void check_writable(const std::filesystem::path& path, std::span<const std::string> layers) {
    checked_format(path);
    check_file_writable(file_of_plane(path, layer_of_picture));
    if (is_for_each_plane(path))
        for (const std::string& layer : layers) check_file_writable(file_of_plane(path, layer));
}

}  // namespace phasetree::tracer
