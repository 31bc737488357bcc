#include "film_file/read.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "phasetree_support/checksum.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::uint64_t start_bytes = 12, around_block = 16, end_bytes = 16;

// A file of known length. Never reads past its end.
class Input {
  public:
    explicit Input(const std::filesystem::path& path) : path_(path) {
        std::error_code problem;
        const auto status = std::filesystem::status(path, problem);
        if (status.type() == std::filesystem::file_type::not_found)
            throw FilmFileMissing(fmt::format("cannot read \"{}\": no such file", path.string()));
        if (problem) throw FilmFileError(fmt::format("cannot read \"{}\": {}", path.string(), problem.message()));
        if (status.type() != std::filesystem::file_type::regular) throw error("it is not a regular file");
        stream_.open(path, std::ios::binary);
        if (!stream_) throw error(std::generic_category().message(errno));
        stream_.seekg(0, std::ios::end);
        bytes_ = static_cast<std::uint64_t>(std::max<std::streamoff>(stream_.tellg(), 0));
    }
    std::uint64_t bytes() const { return bytes_; }

    std::vector<std::byte> read(std::uint64_t from, std::uint64_t count) {
        if (from > bytes_ || count > bytes_ - from) throw error("it is truncated");
        std::vector<std::byte> bytes(count);
        stream_.seekg(static_cast<std::streamoff>(from));
        if (!stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count)))
            throw error("it cannot be read");
        return bytes;
    }
    // The bytes of a block, which must have at least `least`, and the position of its end.
    std::pair<std::vector<std::byte>, std::uint64_t> block(std::uint64_t from, std::uint64_t least) {
        const std::vector<std::byte> size = read(from, 8);
        const auto count = ByteReader(size).number<std::uint64_t>();
        if (count > bytes_ || count < least) throw error("it is damaged");
        std::vector<std::byte> bytes = read(from + 8, count);
        const std::vector<std::byte> after = read(from + 8 + count, 8);
        support::Checksum sum;
        sum.put(bytes.data(), bytes.size());
        if (ByteReader(after).number<std::uint64_t>() != sum.get()) throw error("it is damaged");
        return {std::move(bytes), from + around_block + count};
    }
    FilmFileError error(const std::string& what) const {
        return FilmFileError(fmt::format("cannot use \"{}\": {}", path_.string(), what));
    }

  private:
    std::filesystem::path path_;
    std::ifstream stream_;
    std::uint64_t bytes_ = 0;
};

bool equal(std::span<const std::byte> bytes, std::string_view text) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()) == text;
}

// The minimum size of a pixel in a band: the size of a row of two pixels without samples, minus that of a row of one.
std::uint64_t least_bytes_of_pixel(const FilmFileHeader& header) {
    ByteWriter one, two;
    FilmTile({0, 0, 1, 1}, header.film.planes, header.scene_names).write_row(0, one);
    FilmTile({0, 0, 2, 1}, header.film.planes, header.scene_names).write_row(0, two);
    return two.bytes().size() - one.bytes().size();
}

}  // namespace

FilmFile::FilmFile(const std::filesystem::path& path) : path_(path) {
    Input input(path);
    bytes_ = input.bytes();
    const std::vector<std::byte> magic = input.read(0, std::min<std::uint64_t>(bytes_, film_file_magic.size()));
    if (!equal(magic, film_file_magic.substr(0, magic.size())) || magic.empty())
        throw error("it is neither a part nor a checkpoint");
    if (bytes_ < start_bytes + end_bytes + 2 * around_block) throw error("it is truncated");
    const std::vector<std::byte> format = input.read(8, 4);
    if (ByteReader(format).number<std::uint32_t>() != film_file_format)
        throw error("it was written by another version of phasetree");
    const std::vector<std::byte> end = input.read(bytes_ - end_bytes, end_bytes);
    if (!equal(std::span(end).subspan(8), film_file_end)) throw error("it is truncated");
    try {
        const auto [block, header_end] = input.block(start_bytes, 0);
        ByteReader in(block);
        header_ = FilmFileHeader::read(in);
        const auto bands = static_cast<std::size_t>(header_.bands());
        const auto start = ByteReader(end).number<std::uint64_t>();
        const auto [contents, contents_end] = input.block(start, 8 * bands + 9);
        if (contents_end != bytes_ - end_bytes) throw error("it is damaged");
        ByteReader of_contents(contents);
        // Bands are contiguous, from the header to the contents.
        least_of_pixel_ = least_bytes_of_pixel(header_);
        std::uint64_t least = header_end;
        for (std::size_t i = 0; i < bands; ++i) {
            bands_.push_back(of_contents.number<std::uint64_t>());
            if (bands_.back() < least || bands_.back() > start) throw error("it is damaged");
            least = bands_.back() + around_block + least_of_pixel_ * header_.band(static_cast<int>(i)).size();
        }
        if (least > start) throw error("it is damaged");
        samples_ = of_contents.number<std::uint64_t>();
        is_finished_ = of_contents.number<std::uint8_t>() != 0;
    } catch (const BytesError& e) {
        throw error(e.what());
    }
}

FilmTile FilmFile::band(int i) const {
    Input input(path_);
    const PixelRange area = header_.band(i);
    const auto bytes = input.block(bands_[static_cast<std::size_t>(i)], least_of_pixel_ * area.size()).first;
    FilmTile tile(area, header_.film.planes, header_.scene_names);
    try {
        ByteReader in(bytes);
        for (int y = area.y0; y < area.y1; ++y) tile.read_row(y, in);
        if (in.bytes_left() != 0) throw BytesError("it is damaged");
    } catch (const BytesError& e) {
        throw error(e.what());
    }
    const auto most = static_cast<std::uint32_t>(header_.samples.size());
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            if (tile.samples(x, y) > most) throw error("it is damaged");
    return tile;
}

std::uint32_t FilmFile::most_samples_of_pixel() const {
    std::uint32_t most = 0;
    for (int i = 0; i < header_.bands(); ++i) {
        const FilmTile tile = band(i);
        const PixelRange& area = tile.area();
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x) most = std::max(most, tile.samples(x, y));
    }
    return most;
}

void FilmFile::add_to(Film& film) const {
    for (int i = 0; i < header_.bands(); ++i) film.add(band(i));
}

void FilmFile::check_picture(const FilmFileHeader& wanted) const {
    const std::string what = difference(wanted, header_);
    if (!what.empty()) throw error(what);
}

FilmFileError FilmFile::error(const std::string& what) const {
    return FilmFileError(fmt::format("cannot use \"{}\": {}", path_.string(), what));
}

}  // namespace phasetree::tracer
