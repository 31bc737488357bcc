#include "film_file/write.hpp"

#include <fmt/format.h>

#include "output/error.hpp"
#include "phasetree_support/checksum.hpp"
#include "phasetree_support/whole_file.hpp"

namespace phasetree::tracer {

namespace {

// Runs an operation on a file, and turns its errors into OutputError.
template <class F>
auto named(const std::filesystem::path& path, F&& f) {
    try {
        return f();
    } catch (const support::FileError& error) {
        throw OutputError(fmt::format("cannot write \"{}\": {}", path.string(), error.what()));
    }
}

}  // namespace

struct FilmFileWriter::State {
    explicit State(const std::filesystem::path& p) : path(p), file(p) {}

    std::filesystem::path path;
    support::WholeFile file;
    std::uint64_t offset = 0;
    std::vector<std::uint64_t> bands{};
    std::uint64_t samples = 0;

    void put(std::span<const std::byte> bytes) {
        file.write(bytes);
        offset += bytes.size();
    }
    void put_block(std::span<const std::byte> bytes) {
        ByteWriter before, after;
        before.number(std::uint64_t{bytes.size()});
        support::Checksum sum;
        sum.put(bytes.data(), bytes.size());
        after.number(sum.get());
        put(before.bytes());
        put(bytes);
        put(after.bytes());
    }
};

FilmFileWriter::FilmFileWriter(const std::filesystem::path& path, const FilmFileHeader& header)
    : state_(named(path, [&] { return std::make_unique<State>(path); })) {
    ByteWriter start, block;
    start.append(std::as_bytes(std::span(film_file_magic)));
    start.number(film_file_format);
    header.write(block);
    named(path, [&] {
        state_->put(start.bytes());
        state_->put_block(block.bytes());
    });
}

FilmFileWriter::~FilmFileWriter() = default;

void FilmFileWriter::band(std::span<const std::byte> bytes, std::uint64_t samples) {
    state_->bands.push_back(state_->offset);
    state_->samples += samples;
    named(state_->path, [&] { state_->put_block(bytes); });
}

void FilmFileWriter::finish(bool is_finished) {
    const std::uint64_t start = state_->offset;
    ByteWriter contents, end;
    for (const std::uint64_t band : state_->bands) contents.number(band);
    contents.number(state_->samples);
    contents.number(static_cast<std::uint8_t>(is_finished ? 1 : 0));
    end.number(start);
    end.append(std::as_bytes(std::span(film_file_end)));
    named(state_->path, [&] {
        state_->put_block(contents.bytes());
        state_->put(end.bytes());
        state_->file.finish_on_disk();
    });
}

void write_film(const std::filesystem::path& path, const FilmFileHeader& header, const Film& film, bool is_finished) {
    FilmFileWriter writer(path, header);
    std::uint64_t samples = 0;
    ByteWriter bytes;
    for (int i = 0; i < header.bands(); ++i) {
        const PixelRange band = header.band(i);
        std::uint64_t of_band = 0;
        bytes.clear();
        for (int y = band.y0; y < band.y1; ++y) of_band += film.write_row(y, bytes);
        writer.band(bytes.bytes(), of_band);
        samples += of_band;
    }
    writer.finish(is_finished || samples == header.area.size() * static_cast<std::uint64_t>(header.samples.size()));
}

bool is_film_file(const std::filesystem::path& path) {
    return path.extension() == ".part";
}

}  // namespace phasetree::tracer
