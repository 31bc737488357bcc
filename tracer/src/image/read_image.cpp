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
#include <vector>

#include "phasetree_support/reading.hpp"

namespace phasetree::tracer {

namespace {

// The kinds of files that OpenImageIO decodes as a whole when it opens them, whatever size they claim: known by their
// first bytes, because it looks at these and not only at the name. Nothing of what is not such a file.
std::optional<std::string_view> decoded_when_opened(const std::filesystem::path& path) {
    std::array<char, 12> bytes{};
    std::ifstream(path, std::ios::binary).read(bytes.data(), bytes.size());
    const std::string_view first(bytes.data(), bytes.size());
    if (first.starts_with("RIFF") && first.substr(8) == "WEBP") return "a WebP image";
    if (first.substr(4, 4) == "ftyp") return "a HEIF image or a movie";
    if (first.substr(4, 4) == "jP  " || first.starts_with("\xff\x4f\xff\x51")) return "a JPEG 2000 image";
    return std::nullopt;
}

// Deflate, with which PNG compresses, makes 258 bytes of two bits at best: 1032 to 1.
bool can_hold_what_it_claims(const OIIO::ImageInput& input, std::uintmax_t file_bytes) {
    constexpr std::uintmax_t most = 1032;
    return std::string_view(input.format_name()) != "png" ||
           static_cast<std::uintmax_t>(input.spec().image_bytes(true)) / most <= file_bytes;
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

// OpenImageIO multiplies colours by the alpha beside them, encoded as they are, unless it is told not to. Alpha is not
// used here, and an image's colours are those that its file has.
OIIO::ImageSpec as_stored() {
    OIIO::ImageSpec configuration;
    configuration.attribute("oiio:UnassociatedAlpha", 1);
    return configuration;
}

using Begin = std::function<int(const ImageHeader&)>;
using Add = std::function<void(std::span<const float>)>;

void read(OIIO::ImageInput& input, std::uintmax_t file_bytes, const Begin& begin, const Add& add) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw std::runtime_error("it is empty");
    if (spec.depth > 1) throw std::runtime_error("it is a volume, not an image");
    // Values of fewer bits than a byte are spread over it.
    const int bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(8 * spec.format.size()));
    const int channels = begin({spec.width, spec.height, spec.nchannels, spec.format.is_floating_point(), bits});
    if (!can_hold_what_it_claims(input, file_bytes))
        throw std::runtime_error("it is too short for the size that it claims");
    read_values(input, channels, file_bytes, add);
}

void read(const std::filesystem::path& path, const Begin& begin, const Add& add) {
    // The library's own messages for these two are long and speak of formats and plug-ins.
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw std::runtime_error("there is no such file");
    if (!std::filesystem::is_regular_file(path, ignored)) throw std::runtime_error("it is not a file");
    if (const auto kind = decoded_when_opened(path))
        throw std::runtime_error("it is " + std::string(*kind) +
                                 ", whose size is not known before it is decoded; save it as OpenEXR, PNG or TIFF");
    const OIIO::ImageSpec configuration = as_stored();
    const auto input = OIIO::ImageInput::open(path.string(), &configuration);
    if (!input) throw std::runtime_error(OIIO::geterror());
    read(*input, std::filesystem::file_size(path), begin, add);
}

void read(std::string_view bytes, const Begin& begin, const Add& add) {
    const bool is_png = bytes.starts_with("\x89PNG"), is_jpeg = bytes.starts_with("\xff\xd8");
    if (!is_png && !is_jpeg) throw std::runtime_error("it is neither PNG nor JPEG");
    OIIO::Filesystem::IOMemReader memory(const_cast<char*>(bytes.data()), bytes.size());  // it only reads them
    OIIO::ImageSpec configuration = as_stored();
    OIIO::Filesystem::IOProxy* const from = &memory;
    configuration.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &from);
    const auto input = OIIO::ImageInput::open(is_png ? "in memory.png" : "in memory.jpg", &configuration, &memory);
    if (!input) throw std::runtime_error(OIIO::geterror());
    read(*input, bytes.size(), begin, add);
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
