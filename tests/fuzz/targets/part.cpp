// Parts and checkpoints: unchanged, and again with corrected checksums, without which nothing after them would ever be
// read.
#include <cstring>

#include "film_file/merge.hpp"
#include "fuzz/input_file.hpp"
#include "phasetree_support/checksum.hpp"

namespace phasetree::fuzz {

namespace {

using namespace tracer;

constexpr std::size_t first_block = 12;

// film_file/header.hpp says how blocks lie in a file.
std::string sealed(std::string file) {
    for (std::size_t at = first_block; at + 16 <= file.size();) {
        std::uint64_t count = 0;
        std::memcpy(&count, file.data() + at, 8);
        if (count > file.size() - at - 16) break;
        support::Checksum sum;
        sum.put(file.data() + at + 8, count);
        const std::uint64_t right = sum.get();
        std::memcpy(file.data() + at + 8 + count, &right, 8);
        at += 16 + count;
    }
    return file;
}

void read(const std::filesystem::path& path, std::size_t bytes) {
    try {
        const FilmFile file(path);
        promised(file.header().area.size() <= bytes, "a film takes no more memory than its file allows");
        for (int i = 0; i < file.header().bands(); ++i) {
            const FilmTile band = file.band(i);
            ByteWriter out;
            for (int y = band.area().y0; y < band.area().y1; ++y) band.write_row(y, out);
        }
        Film film(file.header().film, file.header().area, file.header().scene_names);
        file.add_to(film);
        promised(difference(file.header(), file.header()).empty(), "a film is of its own picture");
    } catch (const FilmFileError&) {
    }
    try {
        const Parts parts({path}, true);
        std::size_t rows = 0;
        Image image;
        parts.join(
            [&](const FilmTile& band) {
                if (rows == 0) image = black_image(parts.header().film, parts.header().area, band.channels());
                band.write_into(image, parts.header().area);
                rows += static_cast<std::size_t>(band.area().height());
            },
            [] { return false; });
        promised(rows == static_cast<std::size_t>(image.height), "all bands are joined");
    } catch (const FilmFileError&) {
    }
}

}  // namespace

void run_part(Bytes input) {
    static InputFile file("i.part");
    read(file.write(input), input.size());
    const std::string text = sealed(std::string(text_of(input)));
    read(file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}), text.size());
}

}  // namespace phasetree::fuzz
