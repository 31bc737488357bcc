#include "image/read_image.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "image/jpeg_header.hpp"
#include "image/palette_png.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::tracer {

namespace {

// The first bytes of a file, which identify its format: OpenImageIO checks these as well as the name.
std::string beginning(const std::filesystem::path& path) {
    std::string bytes(32, '\0');
    std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return bytes;
}

// The format of a file that OpenImageIO decodes completely on opening, whatever size it claims; nullopt for other
// files.
std::optional<std::string_view> decoded_when_opened(std::string_view first) {
    if (first.starts_with("RIFF") && first.substr(8, 4) == "WEBP") return "a WebP image";
    if (first.substr(4, 4) == "ftyp") return "a HEIF image or a movie";
    if (first.substr(4, 4) == "jP  " || first.starts_with("\xff\x4f\xff\x51")) return "a JPEG 2000 image";
    return std::nullopt;
}

bool is_jpeg(std::string_view first) {
    return first.starts_with("\xff\xd8");
}

constexpr const char* too_short = "it is too short for the image size in its header";

// Keeps values as stored. By default, OpenImageIO multiplies colours by the alpha channel, even in their encoded form.
// Here alpha is a separate number, and colours are those in the file.
OIIO::ImageSpec as_stored() {
    OIIO::ImageSpec configuration;
    configuration.attribute("oiio:UnassociatedAlpha", 1);
    return configuration;
}

// Lets OpenImageIO decode a PNG or JPEG file in memory. The bytes must outlive this object.
class FileInMemory {
  public:
    explicit FileInMemory(std::string_view bytes)
        : is_png_(is_png(bytes)), reader_(const_cast<char*>(bytes.data()), bytes.size()) {}  // reads the bytes only

    OIIO::ImageInput::unique_ptr open() {
        OIIO::ImageSpec configuration = as_stored();
        OIIO::Filesystem::IOProxy* const from = &reader_;
        configuration.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &from);
        return OIIO::ImageInput::open(is_png_ ? "in memory.png" : "in memory.jpg", &configuration, &reader_);
    }

  private:
    bool is_png_;
    OIIO::Filesystem::IOMemReader reader_;
};

// The minimum size in bytes of a PNG file, computed from its first chunk (ISO 15948, 11.2.2). Deflate codes at best 258
// bytes in 2 bits, so the uncompressed data are at most 1032 times the size of the file. They consist of rows of packed
// samples, each preceded by one byte; interlaced images have more.
std::uintmax_t least_bytes_of_png(std::string_view first) {
    constexpr std::size_t width_at = 16, height_at = 20;
    if (first.size() <= png::kind_at || first.substr(12, 4) != "IHDR") throw std::runtime_error(too_short);
    const auto byte = [&](std::size_t at) { return std::uintmax_t{static_cast<unsigned char>(first[at])}; };
    const auto number = [&](std::size_t at) {
        return byte(at) << 24 | byte(at + 1) << 16 | byte(at + 2) << 8 | byte(at + 3);
    };
    constexpr std::array<std::uintmax_t, 7> samples{1, 1, 3, 1, 2, 1, 4};  // samples per pixel, by colour type
    const std::uintmax_t kind = std::min<std::uintmax_t>(byte(png::kind_at), samples.size() - 1);
    const std::uintmax_t row = (number(width_at) * byte(png::bits_at) * samples[kind] + 7) / 8 + 1;
    constexpr std::uintmax_t most = 1032;
    return row / most * number(height_at) + row % most * number(height_at) / most;
}

// Pixels [x0, x1) × [y0, y1). 64 bits, because windows may have any 32-bit coordinates.
struct Window {
    std::int64_t x0, y0, x1, y1;

    std::int64_t width() const { return x1 - x0; }
    std::int64_t height() const { return y1 - y0; }
};

Window data_window(const OIIO::ImageSpec& spec) {
    return {spec.x, spec.y, std::int64_t{spec.x} + spec.width, std::int64_t{spec.y} + spec.height};
}

// The extent of the picture. The file may contain only a part of it, or more.
Window display_window(const OIIO::ImageInput& input) {
    const OIIO::ImageSpec& spec = input.spec();
    // Other formats have no display window; their pixels are read as stored.
    if (std::string_view(input.format_name()) != "openexr") return data_window(spec);
    return {spec.full_x, spec.full_y, std::int64_t{spec.full_x} + spec.full_width,
            std::int64_t{spec.full_y} + spec.full_height};
}

// Counts the non-finite pixels of an image given in rows.
class NonFinitePixels {
  public:
    NonFinitePixels(std::int64_t width, int channels) : width_(width), channels_(static_cast<std::size_t>(channels)) {}

    void add(std::span<const float> values) {
        for (std::size_t i = 0; i + channels_ <= values.size(); i += channels_, ++pixels_) {
            if (std::ranges::all_of(values.subspan(i, channels_), [](float v) { return std::isfinite(v); })) continue;
            if (count_++ == 0) first_ = pixels_;
        }
    }
    // Throws if there are any.
    void check() const {
        if (count_ == 0) return;
        throw std::runtime_error(fmt::format(
            "{} infinite or not a number, {}at column {}, row {} (counted from 0 at the top left); repair the image, "
            "for example with: oiiotool IN.exr --fixnan box3 -o OUT.exr",
            count_ == 1 ? "1 pixel is" : fmt::format("{} pixels are", count_), count_ == 1 ? "" : "the first ",
            first_ % width_, first_ / width_));
    }

  private:
    std::int64_t width_;
    std::size_t channels_;
    std::int64_t pixels_ = 0, count_ = 0, first_ = 0;
};

// Reads some channels of rows [begin, end), numbered like the data window.
bool read_rows(OIIO::ImageInput& input, std::int64_t begin, std::int64_t end, const ChannelRange& channels,
               float* values) {
    const OIIO::ImageSpec& spec = input.spec();
    const int first = static_cast<int>(begin), last = static_cast<int>(end),
              last_channel = channels.first + channels.count;
    if (spec.tile_width != 0)
        return input.read_tiles(0, 0, spec.x, spec.x + spec.width, first, last, spec.z, spec.z + 1, channels.first,
                                last_channel, OIIO::TypeDesc::FLOAT, values);
    return input.read_scanlines(0, 0, first, last, spec.z, channels.first, last_channel, OIIO::TypeDesc::FLOAT, values);
}

// Converts rows of the data window to rows of the display window. Passes on a few at a time, because the data window
// may be narrow and high and the display window wide.
class ShownRows {
  public:
    ShownRows(const Window& held, const Window& shown, int channels, const AddRows& add)
        : held_(held), shown_(shown), channels_(channels), add_(add) {}

    // Adds rows of zeros.
    void add_empty(std::int64_t rows) {
        for (; rows > 0; rows -= most_rows) {
            values_.assign(count(std::min(rows, most_rows), shown_.width()), 0.0f);
            add_(values_);
        }
    }
    // Adds whole rows of the data window that the display window also contains.
    void add(std::span<const float> values) {
        if (held_.x0 == shown_.x0 && held_.x1 == shown_.x1) return add_(values);
        const std::size_t block = count(most_rows, held_.width());
        for (std::size_t at = 0; at < values.size(); at += block)
            add_block(values.subspan(at, std::min(block, values.size() - at)));
    }

  private:
    static constexpr std::int64_t most_rows = 64;

    void add_block(std::span<const float> values) {
        const std::size_t held = count(1, held_.width()), shown = count(1, shown_.width());
        const std::int64_t x0 = std::max(held_.x0, shown_.x0), x1 = std::min(held_.x1, shown_.x1);
        const std::size_t rows = values.size() / held;
        values_.assign(rows * shown, 0.0f);
        for (std::size_t row = 0; row < rows && x0 < x1; ++row)
            std::ranges::copy(values.subspan(row * held + count(1, x0 - held_.x0), count(1, x1 - x0)),
                              values_.begin() + static_cast<std::ptrdiff_t>(row * shown + count(1, x0 - shown_.x0)));
        add_(values_);
    }
    std::size_t count(std::int64_t rows, std::int64_t columns) const {
        return static_cast<std::size_t>(rows * columns) * static_cast<std::size_t>(channels_);
    }

    Window held_, shown_;
    int channels_;
    const AddRows& add_;
    std::vector<float> values_;
};

// The number of rows that are decoded at a time: whole blocks or tiles, as the format stores them.
std::int64_t rows_at_a_time(const OIIO::ImageSpec& spec) {
    return spec.tile_width != 0 ? spec.tile_height : 64;
}

void read_values(OIIO::ImageInput& input, const ChannelRange& channels, std::uintmax_t file_bytes, const AddRows& add) {
    const OIIO::ImageSpec& spec = input.spec();
    const Window held = data_window(spec), shown = display_window(input);
    support::ReadingPlace place;
    NonFinitePixels non_finite(shown.width(), channels.count);
    const AddRows checked = [&](std::span<const float> values) {
        if (spec.format.is_floating_point()) non_finite.add(values);
        add(values);
    };
    ShownRows rows(held, shown, channels.count, checked);
    const std::int64_t top = std::clamp(held.y0, shown.y0, shown.y1), bottom = std::clamp(held.y1, top, shown.y1);
    rows.add_empty(top - shown.y0);
    const std::int64_t step = rows_at_a_time(spec);
    std::vector<float> values;
    const std::size_t in_row = static_cast<std::size_t>(held.width()) * static_cast<std::size_t>(channels.count);
    const std::int64_t start = top < bottom ? top - (top - held.y0) % step : bottom;
    for (std::int64_t begin = start, end = begin; begin < bottom; begin = end) {
        end = std::min(begin + step, held.y1);
        values.resize(in_row * static_cast<std::size_t>(end - begin));
        if (!read_rows(input, begin, end, channels, values.data())) throw std::runtime_error(input.geterror());
        const std::int64_t first = std::max(begin, top), last = std::min(end, bottom);
        rows.add(std::span(values).subspan(in_row * static_cast<std::size_t>(first - begin),
                                           in_row * static_cast<std::size_t>(last - first)));
        place.reached(file_bytes * static_cast<std::uintmax_t>(end - held.y0) /
                      static_cast<std::uintmax_t>(held.height()));
    }
    rows.add_empty(shown.y1 - bottom);
    place.finished(file_bytes);
    non_finite.check();
}

// Throws if rows of the data window take too much memory, even before any of them is decoded.
void check_memory(const OIIO::ImageSpec& spec, const Window& held) {
    constexpr double most_megabytes = 512, megabyte = 1 << 20;
    const auto rows = static_cast<double>(std::min(rows_at_a_time(spec), held.height()));
    const double megabytes = rows * static_cast<double>(held.width()) * spec.nchannels * sizeof(float) / megabyte;
    if (megabytes > most_megabytes)
        throw std::runtime_error(fmt::format(
            "{} of its data window of {} × {} pixels takes {:.0f} MB, but the limit is {:.0f} MB; crop it{}",
            rows > 1 ? "a block of rows" : "a row", held.width(), held.height(), megabytes, most_megabytes,
            spec.tile_width != 0 ? ", or use smaller tiles" : ""));
}

// Throws for windows that cannot be read. The caller checks the size of the display window. Rows of the
// data window are limited here, because a block of them is also kept in memory.
void check_windows(const OIIO::ImageSpec& spec, const Window& shown) {
    constexpr std::int64_t enough = std::int64_t{1} << 24;
    const Window held = data_window(spec);
    if (shown.width() < 1 || shown.height() < 1) throw std::runtime_error("it is empty");
    if (shown.width() > INT_MAX || shown.height() > INT_MAX)
        throw std::runtime_error("its display window is too large");
    if (held.width() * held.height() > enough && held.width() * held.height() / 4 > shown.width() * shown.height())
        throw std::runtime_error(
            fmt::format("its data window of {} × {} pixels is much larger than its display window of {} × {}; crop it",
                        held.width(), held.height(), shown.width(), shown.height()));
    check_memory(spec, held);
}

// The number of bits per value, before values of fewer than 8 bits are scaled to a full byte. `first` is the beginning
// of the file.
int bits_of(const OIIO::ImageInput& input, std::string_view first) {
    // OpenImageIO does not report the bits of a PNG file, which its first chunk holds. Those of a palette are of its
    // indices; its colours have 8.
    if (std::string_view(input.format_name()) == "png" && first.size() > png::kind_at && first[png::kind_at] != 3)
        return static_cast<unsigned char>(first[png::bits_at]);
    return input.spec().get_int_attribute("oiio:BitsPerSample", static_cast<int>(8 * input.spec().format.size()));
}

ImageHeader header_of(const OIIO::ImageInput& input, std::string_view first) {
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw std::runtime_error("it is empty");
    if (spec.depth > 1) throw std::runtime_error("it is a volume, not an image");
    if (std::string_view(input.format_name()) == "tiff" &&
        (spec.full_width != spec.width || spec.full_height != spec.height))
        throw std::runtime_error(fmt::format(
            "its {} × {} pixels are a crop of a {} × {} picture; save the whole picture, or save the crop as OpenEXR",
            spec.width, spec.height, spec.full_width, spec.full_height));
    const Window shown = display_window(input);
    check_windows(spec, shown);
    return {.width = static_cast<int>(shown.width()),
            .height = static_cast<int>(shown.height()),
            .channels = spec.nchannels,
            .is_floating_point = spec.format.is_floating_point(),
            .bits = bits_of(input, first),
            .is_signed = spec.format.is_signed()};
}

// A file to read: its size, its first bytes, all its bytes from the beginning, and how OpenImageIO opens it.
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

// Opening a JPEG file may decode it, so ask beforehand whether the image is wanted.
void read_jpeg(const Source& source, const BeginImage& begin, const AddRows& add) {
    const JpegHeader jpeg = read_jpeg_header(source.next);
    // OpenImageIO converts the inks of CMYK files to three colour channels.
    const ImageHeader header{.width = jpeg.width,
                             .height = jpeg.height,
                             .channels = jpeg.components == 4 ? 3 : jpeg.components,
                             .bits = jpeg.bits};
    const ChannelRange channels = begin(header);
    if (source.bytes < jpeg.least_bytes) throw std::runtime_error(too_short);
    const auto input = source.open();
    const ImageHeader decoded = header_of(*input, source.first);
    if (decoded.width != header.width || decoded.height != header.height || decoded.channels != header.channels)
        throw std::runtime_error("the decoded image has a different size than its header declares");
    read_values(*input, channels, source.bytes, add);
}

void read(const Source& source, const BeginImage& begin, const AddRows& add) {
    if (is_jpeg(source.first)) return read_jpeg(source, begin, add);
    const auto input = source.open();
    const ChannelRange channels = begin(header_of(*input, source.first));
    if (std::string_view(input->format_name()) == "png" && source.bytes < least_bytes_of_png(source.first))
        throw std::runtime_error(too_short);
    read_values(*input, channels, source.bytes, add);
}

void read(const std::filesystem::path& path, const BeginImage& begin, const AddRows& add) {
    // The library's messages for these two cases are long and refer to formats and plug-ins.
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw std::runtime_error("no such file");
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

void read(std::string_view bytes, const BeginImage& begin, const AddRows& add) {
    if (!is_png(bytes) && !is_jpeg(bytes)) throw std::runtime_error("it is neither PNG nor JPEG");
    FileInMemory memory(bytes);
    const auto next = [left = bytes]() mutable { return std::exchange(left, {}); };
    read({bytes.size(), std::string(bytes.substr(0, 32)), next, [&] { return memory.open(); }}, begin, add);
}

// Reads the indices of a PNG file with a palette.
void read_indices(const std::filesystem::path& path, const PaletteHeader& palette, const BeginImage& begin,
                  const AddRows& add) {
    const ImageHeader header{.width = palette.width, .height = palette.height, .channels = 1, .bits = palette.bits};
    const ChannelRange channels = begin(header);
    const std::uintmax_t file_bytes = std::filesystem::file_size(path);
    if (file_bytes < least_bytes_of_png(beginning(path))) throw std::runtime_error(too_short);
    const std::string grey = as_grey_png(path, palette);
    FileInMemory memory(grey);
    const auto input = memory.open();
    if (!input) throw std::runtime_error(OIIO::geterror());
    read_values(*input, channels, file_bytes, add);
}

// Calls f, and makes its errors name the image that cannot be used.
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

void read_image(const std::filesystem::path& path, const std::string& what, const BeginImage& begin,
                const AddRows& add) {
    with_name(what, path.string(), [&] { read(path, begin, add); });
}

void read_image_in_memory(std::string_view bytes, const std::string& name, const std::string& what,
                          const BeginImage& begin, const AddRows& add) {
    with_name(what, name, [&] { read(bytes, begin, add); });
}

void read_labels(const std::filesystem::path& path, const std::string& what, const BeginImage& begin,
                 const AddRows& add) {
    with_name(what, path.string(), [&] {
        if (const auto palette = palette_header(beginning(path)))
            read_indices(path, *palette, begin, add);
        else
            read(path, begin, add);
    });
}

}  // namespace phasetree::tracer
