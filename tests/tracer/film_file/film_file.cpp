// Files of films: what is written is read back, and anything else is rejected.
#include "film_file/read.hpp"

#include <doctest/doctest.h>

#include "film/path_record.hpp"
#include "film_file/write.hpp"
#include "output/error.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "support/uniform.hpp"

namespace test_film_file {

using namespace phasetree::tracer;
using namespace phasetree;
using phasetree::tests::Uniform;

namespace {

FilmFileHeader header_of(const FilmSettings& settings, const PixelRange& area) {
    FilmFileHeader h;
    h.settings = {{"version", "1.2.3+aa"}, {"commit", "12ab"}, {"scene", "0123"}, {"seed", "4"}};
    h.film = settings;
    h.scene_names = {{"vacuum", "gläss", ""}, {"lamp"}, {"object", "floor"}};
    h.area = h.shown = area;
    h.samples = {3, 5};
    h.samples_in_all = 9;
    h.scene = "a.json";
    h.seed = 4;
    h.exposure_ev = -0.5f;
    h.view = "Filmic";
    return h;
}

// Two samples for each pixel, except for one pixel that has one, and one that has none.
FilmTile film_of(const FilmFileHeader& h) {
    Uniform random(3);
    FilmTile tile(h.area, h.film.planes, h.scene_names);
    for (int y = h.area.y0; y < h.area.y1; ++y)
        for (int x = h.area.x0; x < h.area.x1; ++x)
            for (std::uint32_t s = 0; s < 2; ++s) {
                if ((x == h.area.x0 && y == h.area.y0) || (x == h.area.x0 + 1 && y == h.area.y0 && s > 0)) continue;
                PathRecord record;
                record.lengths = {random(), random(), random()};
                record.groups = {glm::vec3(random())};
                FilmSample sample{.radiance = {random(), 100 * random(), -random()}, .number = s, .record = &record};
                tile.add(x, y, sample);
            }
    return tile;
}

bool same_rows(const FilmTile& a, const FilmTile& b) {
    for (int y = a.area().y0; y < a.area().y1; ++y) {
        ByteWriter of_a, of_b;
        a.write_row(y, of_a);
        b.write_row(y, of_b);
        if (of_a.bytes() != of_b.bytes()) return false;
    }
    return true;
}

struct Written {
    support::TemporaryDirectory folder;
    std::filesystem::path path = folder / "a.part";
    FilmFileHeader header;
    std::string bytes;

    explicit Written(const FilmFileHeader& h) : header(h) {
        write();
        bytes = support::bytes_of(path);
    }
    void write() const {
        Film film(header.film, header.area, header.scene_names);
        film.add(film_of(header));
        write_film(path, header, film);
    }
    // The message with which a file of these bytes is rejected; empty if it is accepted.
    std::string refusal(const std::string& of) const {
        support::write_text(path, of);
        try {
            const FilmFile file(path);
            Film film(file.header().film, file.header().area, file.header().scene_names);
            file.add_to(film);
            return "";
        } catch (const FilmFileError& e) {
            return e.what();
        }
    }
};

}  // namespace

TEST_CASE("a film with all planes is read as it was written, and says what it is of") {
    const Written written(header_of({.width = 40, .height = 50, .planes = Planes::all()}, {2, 3, 9, 40}));
    const FilmFile file(written.path);
    const FilmFileHeader &h = file.header(), &wanted = written.header;
    CHECK(difference(wanted, h) == "");
    CHECK(h.bands() == 3);
    CHECK(h.samples == wanted.samples);
    CHECK(h.samples_in_all == 9);
    CHECK(h.scene == "a.json");
    CHECK(h.seed == 4);
    CHECK(h.exposure_ev == -0.5f);
    CHECK(h.view == "Filmic");
    const bool same_names = h.scene_names == wanted.scene_names;
    CHECK(same_names);
    CHECK_FALSE(file.is_finished());
    CHECK(file.samples() == 2 * 7 * 37 - 3);
    Film film(h.film, h.area, h.scene_names);
    file.add_to(film);
    CHECK(same_rows(film.pixels(), film_of(wanted)));
}

TEST_CASE("what differs is named") {
    const FilmFileHeader wanted = header_of({.width = 8, .height = 8}, {0, 0, 8, 8});
    FilmFileHeader found = wanted;
    found.settings[0].second = "1.2.3+bb";
    found.settings[1].second = "34cd with changes";
    CHECK(difference(wanted, found) ==
          "it was rendered by phasetree 1.2.3+bb (commit 34cd with changes), not by phasetree 1.2.3+aa (commit 12ab); "
          "render all samples of a picture with the same build");
    found.settings[0].second = "1.2.2\n\xe9";
    found.settings.erase(found.settings.begin() + 1);  // as older versions wrote it
    CHECK(difference(wanted, found) ==
          "it was rendered by phasetree 1.2.2\\x0a\\xe9, not by phasetree 1.2.3+aa (commit 12ab); render all samples "
          "of a picture with the same build");
    found = wanted;
    found.settings[1].second = "";  // an archive of the same sources
    CHECK(difference(wanted, found) == "");
    found = wanted;
    found.settings[3].second = "5\n\x1b[2J";
    CHECK(difference(wanted, found) == "it has seed 5\\x0a\\x1b[2J, not 4");
    found = wanted;
    found.settings.pop_back();
    CHECK(difference(wanted, found) == "it was written by another version of phasetree");
    CHECK(difference(found, wanted) == "");  // of the first settings alone
    found = wanted;
    found.scene_names.groups.push_back("sky");
    CHECK(difference(wanted, found) == "it belongs to another picture");
}

TEST_CASE("wherever a file ends too early, it is rejected") {
    const Written written(header_of({.width = 5, .height = 20, .planes = Planes::all()}, {0, 0, 5, 20}));
    for (std::size_t count = 0; count < written.bytes.size(); count += count < 400 ? 1 : 17) {
        CAPTURE(count);
        const std::string why = written.refusal(written.bytes.substr(0, count));
        CHECK(why.starts_with("cannot use \"" + written.path.string() + "\": it is "));
        CHECK((why.ends_with("it is truncated") ||
               (count == 0 && why.ends_with("it is neither a part nor a checkpoint"))));
    }
    CHECK(written.refusal(written.bytes + "x").ends_with("it is truncated"));
    CHECK(written.refusal(written.bytes) == "");
}

TEST_CASE("whichever byte is another one, the file is rejected") {
    const Written written(header_of({.width = 5, .height = 20, .planes = Planes::all()}, {0, 0, 5, 20}));
    Uniform random(1);
    for (std::size_t at = 0; at < written.bytes.size(); at += at < 400 || at + 200 > written.bytes.size() ? 1 : 13) {
        CAPTURE(at);
        std::string changed = written.bytes;
        changed[at] = static_cast<char>(changed[at] ^ (1 << static_cast<int>(8 * random())));
        CHECK(written.refusal(changed) != "");
    }
}

TEST_CASE("an image where a part was meant, and a file of another format") {
    const Written written(header_of({.width = 5, .height = 5}, {0, 0, 5, 5}));
    CHECK(written.refusal("\x89PNG\r\n and more").ends_with("it is neither a part nor a checkpoint"));
    std::string later = written.bytes;
    later[8] = static_cast<char>(film_file_format + 1);
    CHECK(written.refusal(later).ends_with("it was written by another version of phasetree"));
}

TEST_CASE("a file that cannot be written is named, and what was there stays") {
    const Written written(header_of({.width = 5, .height = 5}, {0, 0, 5, 5}));
    const FilmFileHeader& h = written.header;
    try {
        FilmFileWriter writer(written.folder / "nowhere" / "b.part", h);
        CHECK(false);
    } catch (const OutputError& e) {
        CHECK(std::string(e.what()).find("b.part") != std::string::npos);
    }
    {
        FilmFileWriter unfinished(written.path, h);
        unfinished.band({}, 0);
    }
    CHECK(support::bytes_of(written.path) == written.bytes);
    CHECK(written.folder.size() == 1);
}

TEST_CASE("what a process left that was killed is taken away, and what another is writing stays") {
    const Written written(header_of({.width = 5, .height = 5}, {0, 0, 5, 5}));
    const auto left = written.folder / ".a.part.4242.7.tmp";
    for (const char* name : {".a.part.4242.7.tmp", ".a.part.x.tmp", ".b.part.1.2.tmp", "a.part.1.2.tmp"})
        support::write_text(written.folder / name, "half of");
    {
        FilmFileWriter at_work(written.path, written.header);
        CHECK_FALSE(std::filesystem::exists(left));
        CHECK(written.folder.size() == 5);
        written.write();
        CHECK(written.folder.size() == 5);
        at_work.band({}, 0);
        at_work.finish(false);
    }
    CHECK(written.folder.size() == 4);
    CHECK(support::bytes_of(written.path) != written.bytes);
}

TEST_CASE("the pixels of the picture are some of the film's") {
    FilmFileHeader h = header_of({.width = 40, .height = 30}, {8, 8, 24, 16});
    h.shown = {9, 8, 20, 15};
    const Written written(h);
    const FilmFile file(written.path);
    CHECK(file.header().shown.x0 == 9);
    CHECK(file.header().shown.y1 == 15);
    FilmFileHeader other = h;
    other.shown = h.area;
    CHECK(difference(other, file.header()) == "it belongs to another picture");
    for (const PixelRange outside : {PixelRange{7, 8, 20, 15}, PixelRange{9, 8, 25, 15}, PixelRange{9, 8, 9, 15}}) {
        h.shown = outside;
        const Written wrong(h);
        CHECK(wrong.refusal(wrong.bytes).find("out of range") != std::string::npos);
    }
}

}  // namespace test_film_file
