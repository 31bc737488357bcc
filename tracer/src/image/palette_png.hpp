// PNG files with a palette (ISO 15948), whose pixels are indices. Segmentation tools store labels this way, with a
// colour per label for viewing. Image decoders return the colours. However, the samples of such a file are stored like
// those of a greyscale file, so replacing the header and removing the palette makes it decode to its indices.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace phasetree::tracer {

inline constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

inline bool is_png(std::string_view bytes) {
    return bytes.starts_with(png_signature);
}

struct PaletteHeader {
    int width = 0;
    int height = 0;
    int bits = 0;  ///< per index: 1, 2, 4 or 8
};

namespace png {

inline std::uint32_t number(std::string_view bytes) {
    std::uint32_t n = 0;
    for (const char c : bytes.substr(0, 4)) n = n << 8 | static_cast<unsigned char>(c);
    return n;
}

inline std::string bytes_of(std::uint32_t n) {
    return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8), static_cast<char>(n)};
}

constexpr std::size_t bits_at = 24, kind_at = 25,
                      header_end = 33;  // offsets in a file; the header ends with its checksum

}  // namespace png

/// Parses the first 32 bytes of a file. Returns nullopt if it is not a PNG file, or has no palette.
inline std::optional<PaletteHeader> palette_header(std::string_view first) {
    if (first.size() <= png::kind_at || !is_png(first) || first.substr(12, 4) != "IHDR" || first[png::kind_at] != 3)
        return std::nullopt;
    const std::uint32_t width = png::number(first.substr(16)), height = png::number(first.substr(20));
    const int bits = static_cast<unsigned char>(first[png::bits_at]);
    constexpr auto most = static_cast<std::uint32_t>(std::numeric_limits<int>::max());
    if (width < 1 || height < 1 || width > most || height > most) throw std::runtime_error("its size is invalid");
    if (bits != 1 && bits != 2 && bits != 4 && bits != 8)
        throw std::runtime_error("its palette has indices of " + std::to_string(bits) + " bits, not of 1, 2, 4 or 8");
    return PaletteHeader{static_cast<int>(width), static_cast<int>(height), bits};
}

/// The bytes of a greyscale PNG file whose values are the indices of this file. Throws std::runtime_error for a
/// truncated file. Takes at most about twice the memory of the decoded indices.
inline std::string as_grey_png(const std::filesystem::path& path, const PaletteHeader& header) {
    constexpr const char* cut_off = "its image data are truncated";
    std::ifstream file(path, std::ios::binary);
    std::string grey(png::header_end, '\0');
    if (!file.read(grey.data(), static_cast<std::streamsize>(grey.size()))) throw std::runtime_error(cut_off);
    grey[png::kind_at] = 0;
    const std::string_view checked = std::string_view(grey).substr(12, 17);
    const uLong crc = ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    grey.replace(29, 4, png::bytes_of(static_cast<std::uint32_t>(crc)));

    const std::uint64_t row =
        (static_cast<std::uint64_t>(header.width) * static_cast<unsigned>(header.bits) + 7) / 8 + 1;
    const std::uint64_t most = 2 * row * static_cast<std::uint64_t>(header.height) + (1 << 20);
    const std::uint64_t file_bytes = std::filesystem::file_size(path);
    for (std::uint64_t at = png::header_end; !grey.ends_with(std::string_view("IEND\xae\x42\x60\x82"));) {
        std::string chunk(8, '\0');
        if (!file.read(chunk.data(), 8)) throw std::runtime_error(cut_off);
        const std::uint64_t rest = std::uint64_t{png::number(chunk)} + 4;  // data and checksum
        at += 8 + rest;
        if (at > file_bytes) throw std::runtime_error(cut_off);
        const bool is_kept = chunk.ends_with("IDAT") || chunk.ends_with("IEND");
        if (!is_kept) {
            file.seekg(static_cast<std::streamoff>(rest), std::ios::cur);
            continue;
        }
        if (grey.size() + rest > most) throw std::runtime_error("it has more data than its size needs");
        chunk.resize(8 + static_cast<std::size_t>(rest));
        if (!file.read(chunk.data() + 8, static_cast<std::streamsize>(rest))) throw std::runtime_error(cut_off);
        grey += chunk;
    }
    return grey;
}

}  // namespace phasetree::tracer
