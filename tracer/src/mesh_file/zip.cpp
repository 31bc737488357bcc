#include "mesh_file/zip.hpp"

#include <zlib.h>

#include <limits>
#include <stdexcept>

#include "mesh_file/bytes_as_text.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::uint16_t zip_version = 20, deflated = 8, date = 0x21;  // 1 January 1980

// A raw Deflate stream, without zlib's header.
std::string deflate_of(const std::string& bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    std::string result(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    const int end = deflate(&stream, Z_FINISH);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    if (end != Z_STREAM_END) throw std::length_error("the archive could not be compressed");
    return result;
}

std::uint32_t size_of(const std::string& bytes) {
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max() / 2)
        throw std::length_error("a file in the archive would be larger than 2 GB; use a larger --spacing");
    return static_cast<std::uint32_t>(bytes.size());
}

// The fields that a local file header and the central directory have in common, from the version on.
void describe(ByteWriter& out, const ZipFile& file, const std::string& packed) {
    out.number(zip_version);
    out.number(std::uint16_t{0});
    out.number(deflated);
    out.number(std::uint16_t{0});
    out.number(date);
    out.number(static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(file.bytes.data()), static_cast<uInt>(file.bytes.size()))));
    out.number(size_of(packed));
    out.number(size_of(file.bytes));
    out.number(static_cast<std::uint16_t>(file.name.size()));
    out.number(std::uint16_t{0});
}

}  // namespace

std::string zip_of(std::span<const ZipFile> files) {
    ByteWriter out, list;
    for (const ZipFile& file : files) {
        size_of(file.bytes);
        const std::string packed = deflate_of(file.bytes);
        const auto place = static_cast<std::uint32_t>(out.bytes().size());
        out.number(std::uint32_t{0x04034b50});
        describe(out, file, packed);
        append_text(out, file.name);
        append_text(out, packed);
        list.number(std::uint32_t{0x02014b50});
        list.number(zip_version);
        describe(list, file, packed);
        for (int i = 0; i < 3; ++i) list.number(std::uint16_t{0});
        list.number(std::uint32_t{0});
        list.number(place);
        append_text(list, file.name);
        if (out.bytes().size() > std::numeric_limits<std::uint32_t>::max() / 2)
            throw std::length_error("the archive would be larger than 2 GB; use a larger --spacing");
    }
    const auto place = static_cast<std::uint32_t>(out.bytes().size());
    out.append(list.bytes());
    out.number(std::uint32_t{0x06054b50});
    out.number(std::uint32_t{0});
    out.number(static_cast<std::uint16_t>(files.size()));
    out.number(static_cast<std::uint16_t>(files.size()));
    out.number(static_cast<std::uint32_t>(list.bytes().size()));
    out.number(place);
    out.number(std::uint16_t{0});
    return bytes_as_text(out);
}

}  // namespace phasetree::tracer
