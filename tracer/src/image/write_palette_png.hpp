// Writes labels as a PNG file with a palette, which palette_png.hpp reads.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "image/palette_png.hpp"

namespace phasetree::tracer {

namespace png {

inline std::string chunk(std::string_view name, std::string_view data) {
    const std::string checked = std::string(name) + std::string(data);
    const uLong crc = ::crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    return bytes_of(static_cast<std::uint32_t>(data.size())) + checked + bytes_of(static_cast<std::uint32_t>(crc));
}

}  // namespace png

/// The bytes of a file of `width` columns. `indices` are its pixels, row by row from the top, each an index of
/// `palette`, which has at most 256 sRGB colours. There are less than 2³¹ pixels. Throws std::bad_alloc.
inline std::string palette_png(int width, std::span<const std::uint8_t> indices,
                               std::span<const std::array<int, 3>> palette) {
    const auto columns = static_cast<std::size_t>(width), rows = indices.size() / columns;
    std::string header = png::bytes_of(static_cast<std::uint32_t>(columns));
    header += png::bytes_of(static_cast<std::uint32_t>(rows));
    header += {8, 3, 0, 0, 0};  // bits per index, a palette, and the only methods of compression and filtering
    std::string colors;
    for (const std::array<int, 3>& color : palette)
        for (const int code : color) colors += static_cast<char>(code);
    std::string lines;
    lines.reserve(rows * (columns + 1));
    for (std::size_t row = 0; row < rows; ++row) {
        lines += '\0';  // unfiltered
        for (const std::uint8_t index : indices.subspan(row * columns, columns)) lines += static_cast<char>(index);
    }
    uLongf size = ::compressBound(static_cast<uLong>(lines.size()));
    std::string compressed(size, '\0');
    if (::compress2(reinterpret_cast<Bytef*>(compressed.data()), &size, reinterpret_cast<const Bytef*>(lines.data()),
                    static_cast<uLong>(lines.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
        throw std::bad_alloc();
    compressed.resize(size);
    return std::string(png_signature) + png::chunk("IHDR", header) + png::chunk("PLTE", colors) +
           png::chunk("IDAT", compressed) + png::chunk("IEND", "");
}

}  // namespace phasetree::tracer
