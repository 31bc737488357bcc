#include "image/read_image.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "image/jpeg_header.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::tracer {

namespace {

// The first bytes of a file, by which its kind is known: OpenImageIO looks at these and not only at the name.
std::string beginning(const std::filesystem::path& path) {
    std::string bytes(32, '\0');
    std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return bytes;
}

// The kinds of files that OpenImageIO decodes as a whole when it opens them, whatever size they claim. Nothing of what
// is not such a file.
std::optional<std::string_view> decoded_when_opened(std::string_view first) {
    if (first.starts_with("RIFF") && first.substr(8, 4) == "WEBP") return "a WebP image";
    if (first.substr(4, 4) == "ftyp") return "a HEIF image or a movie";
    if (first.substr(4, 4) == "jP  " || first.starts_with("\xff\x4f\xff\x51")) return "a JPEG 2000 image";
    return std::nullopt;
}

bool is_jpeg(std::string_view first) {
    return first.starts_with("\xff\xd8");
}

constexpr const char* too_short = "it is too short for the size that it claims";

// How many bytes a PNG file has at least, by its first chunk (ISO 15948, 11.2.2). Deflate, which compresses it, can at
// best code 258 bytes in 2 bits, so uncompressed data are at most 1032 times the file. They are rows of packed samples,
// each row with a byte before it; interlaced images have more.
std::uintmax_t least_bytes_of_png(std::string_view first) {
    constexpr std::size_t width_at = 16, height_at = 20, bits_at = 24, kind_at = 25;
    if (first.size() <= kind_at || first.substr(12, 4) != "IHDR") throw std::runtime_error(too_short);
    const auto byte = [&](std::size_t at) { return std::uintmax_t{static_cast<unsigned char>(first[at])}; };
    const auto number = [&](std::size_t at) {
        return byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
    };
    constexpr std::array<std::uintmax_t, 7> samples{1, 1, 3, 1, 2, 1, 4};  // of a pixel, of each kind of colour
    const std::uintmax_t kind = std::min<std::uintmax_t>(byte(kind_at), samples.size() - 1);
    const std::uintmax_t row = (number(width_at) * byte(bits_at) * samples[kind] + 7) / 8 + 1;
    constexpr std::uintmax_t most = 1032;
    return row / most * number(height_at) + row % most * number(height_at) / most;
}

// The first channels of rows [begin, end), counted from 0.
bool read_rows(OIIO::ImageInput& input, int begin, int end, int channels, float* values) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.tile_width != 0)
        return input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + begin, spec.y + end, spec.z, spec.z + 1, 0,
                                channels, OIIO::TypeDesc::FLOAT, values);
    return input.read_scanlines(0, 0, spec.y + begin, spec.y + end, spec.z, 0, channels, OIIO::TypeDesc::FLOAT, values);
}

void read_values(OIIO::ImageInput& input, int channels, std::uintmax_t file_bytes,
                 const std::function<void(std::span<const float>)>& add) {
    const OIIO::ImageSpec& spec = input.spec();
    support::ReadingPlace place;
    // Whole blocks and tiles, as the formats make them.
    const int step = spec.tile_width != 0 ? spec.tile_height : 64;
    std::vector<float> values;
    for (int begin = 0; begin < spec.height; begin += step) {
        const int end = std::min(begin + step, spec.height);
        values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(end - begin) *
                      static_cast<std::size_t>(channels));
        if (!read_rows(input, begin, end, channels, values.data())) throw std::runtime_error(input.geterror());
        add(values);
        place.reached(file_bytes * static_cast<std::uintmax_t>(end) / static_cast<std::uintmax_t>(spec.height));
    }
    place.finished(file_bytes);
}

// OpenImageIO multiplies colours by the alpha beside them, encoded as they are, unless it is told not to. Alpha is
// a number of its own here, and an image's colours are those that its file has.
OIIO::ImageSpec as_stored() {
    OIIO::ImageSpec configuration;
    configuration.attribute("oiio:UnassociatedAlpha", 1);
    return configuration;
}

using Begin = std::function<int(const ImageHeader&)>;
using Add = std::function<void(std::span<const float>)>;

ImageHeader header_of(const OIIO::ImageInput& input) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw std::runtime_error("it is empty");
    if (spec.depth > 1) throw std::runtime_error("it is a volume, not an image");
    // Values of fewer bits than a byte are spread over it.
    const int bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(8 * spec.format.size()));
    return {spec.width, spec.height, spec.nchannels, spec.format.is_floating_point(), bits, spec.format.is_signed()};
}

// A file to be read: its size, its first bytes, all of them from its beginning, and how OpenImageIO opens it.
struct Source {
    std::uintmax_t bytes;
    std::string first;
    NextBytes next;
    std::function<OIIO::ImageInput::unique_ptr()> opened;

    OIIO::ImageInput::unique_ptr open() const {
        auto input = opened();
        if (!input) throw std::runtime_error(OIIO::geterror());
        return input;
    }
};

// To open a JPEG may be to decode it. So it is asked before whether it is wanted.
void read_jpeg(const Source& source, const Begin& begin, const Add& add) {
    const JpegHeader jpeg = read_jpeg_header(source.next);
    // OpenImageIO makes colours of three channels of inks.
    const ImageHeader header{jpeg.width, jpeg.height, jpeg.components == 4 ? 3 : jpeg.components, false, jpeg.bits};
    const int channels = begin(header);
    if (source.bytes < jpeg.least_bytes) throw std::runtime_error(too_short);
    const auto input = source.open();
    const ImageHeader decoded = header_of(*input);
    if (decoded.width != header.width || decoded.height != header.height || decoded.channels != header.channels)
        throw std::runtime_error("it decodes to another size than its header says");
    read_values(*input, channels, source.bytes, add);
}

void read(const Source& source, const Begin& begin, const Add& add) {
    if (is_jpeg(source.first)) return read_jpeg(source, begin, add);
    const auto input = source.open();
    const int channels = begin(header_of(*input));
    if (std::string_view(input->format_name()) == "png" && source.bytes < least_bytes_of_png(source.first))
        throw std::runtime_error(too_short);
    read_values(*input, channels, source.bytes, add);
}

void read(const std::filesystem::path& path, const Begin& begin, const Add& add) {
    // The library's own messages for these two are long and speak of formats and plug-ins.
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw std::runtime_error("there is no such file");
    if (!std::filesystem::is_regular_file(path, ignored)) throw std::runtime_error("it is not a file");
    const std::string first = beginning(path);
    if (const auto kind = decoded_when_opened(first))
        throw std::runtime_error("it is " + std::string(*kind) +
                                 ", whose size is not known before it is decoded; save it as OpenEXR, PNG or TIFF");
    std::ifstream file(path, std::ios::binary);
    std::string block;
    const auto next = [&]() -> std::string_view {
        block.resize(1 << 16);
        file.read(block.data(), static_cast<std::streamsize>(block.size()));
        return std::string_view(block).substr(0, static_cast<std::size_t>(file.gcount()));
    };
    const auto open = [&] {
        const OIIO::ImageSpec configuration = as_stored();
        return OIIO::ImageInput::open(path.string(), &configuration);
    };
    read({std::filesystem::file_size(path), first, next, open}, begin, add);
}

void read(std::string_view bytes, const Begin& begin, const Add& add) {
    const bool is_png = bytes.starts_with("\x89PNG");
    if (!is_png && !is_jpeg(bytes)) throw std::runtime_error("it is neither PNG nor JPEG");
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());  // it only reads them
    const auto open = [&] {
        OIIO::ImageSpec configuration = as_stored();
        OIIO::Filesystem::IOProxy* const from = &memory;
        configuration.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &from);
        return OIIO::ImageInput::open(is_png ? "in memory.png" : "in memory.jpg", &configuration, &memory);
    };
    const auto next = [left = bytes]() mutable { return std::exchange(left, {}); };
    read({bytes.size(), std::string(bytes.substr(0, 32)), next, open}, begin, add);
}

// Calls f, whose errors then say which image cannot be used.
template <class F>
void with_name(const std::string& what, const std::string& name, F&& f) {
    try {
        f();
    } catch (const std::runtime_error& e) {
        const std::string message = e.what();
        throw std::runtime_error("cannot use the " + what + " \"" + name +
                                 "\": " + message.substr(0, message.find('\n')));
    }
}

}  // namespace

void read_image(const std::filesystem::path& path, const std::string& what, const Begin& begin, const Add& add) {
    with_name(what, path.string(), [&] { read(path, begin, add); });
}

void read_image_in_memory(std::string_view bytes, const std::string& name, const std::string& what, const Begin& begin,
                          const Add& add) {
    with_name(what, name, [&] { read(bytes, begin, add); });
}

}  // namespace phasetree::tracer
