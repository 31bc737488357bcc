// The film: samples that are divided between tiles in any way, the values that planes record, and crops.
#include "film/film.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "film/sums/count.hpp"
#include "film/sums/first_value.hpp"

namespace test_film {

using namespace phasetree::tracer;

namespace {

// The value of the first sample, and the number of samples: two channels of a layer.
struct FirstPlane {
    using Sum = FirstValue<1>;
    static constexpr std::string_view name = "first";
    static constexpr bool by_default = false;
    explicit FirstPlane(const SceneNames&) {}
    std::vector<std::string> channels() const { return {"first.Y", "first.count"}; }
    std::size_t sums() const { return 1; }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults&) const {
        sums[0].add({sample.radiance.g}, sample.number);
    }
    void resolve(std::span<const Sum> sums, std::uint32_t samples, std::span<float> values) const {
        values[0] = sums[0].values(-1)[0];
        values[1] = static_cast<float>(samples);
    }
};

// A channel for each phase, as in planes that depend on the scene.
struct PhasesPlane {
    using Sum = Count;
    static constexpr std::string_view name = "phases";
    static constexpr bool by_default = true;
    explicit PhasesPlane(const SceneNames& scene_names) : names(scene_names.phases) {}
    std::vector<std::string> channels() const { return names; }
    std::size_t sums() const { return names.size(); }
    void add(std::span<Sum> sums, const FilmSample& sample, FilmFaults&) const {
        ++sums[sample.number % sums.size()].count;
    }
    void resolve(std::span<const Sum> sums, std::uint32_t, std::span<float> values) const {
        for (std::size_t i = 0; i < sums.size(); ++i) values[i] = static_cast<float>(sums[i].count);
    }
    std::vector<std::string> names;
};

// A plane whose sums depend on the order.
struct WrongPlane : FirstPlane {
    using Sum = float;
};

static_assert(PlaneKind<RadiancePlane> && PlaneKind<FirstPlane> && PlaneKind<PhasesPlane>);
static_assert(!PlaneKind<WrongPlane> && !PlaneKind<int>);

// Values whose sum in floats would depend on the order: sample s of a pixel.
FilmSample sample_of(int x, int y, int s) {
    const float value = 1.0f / static_cast<float>(3 + 7 * x + 11 * y + 13 * s);
    return {{value, 1e10f * value, 1e-10f * value}, static_cast<std::uint32_t>(s)};
}

const FilmSettings small{.width = 10, .height = 6};

bool equal(const Film& a, const Film& b) {
    ByteWriter of_a, of_b;
    for (int y = a.area().y0; y < a.area().y1; ++y) {
        a.pixels().write_row(y, of_a);
        b.pixels().write_row(y, of_b);
    }
    return of_a.bytes() == of_b.bytes() && a.image().pixels == b.image().pixels &&
           a.pixels().faults() == b.pixels().faults();
}

}  // namespace

TEST_CASE("film: samples may be divided among tiles in any way") {
    Film one(small, small.whole());
    FilmTile all = one.tile(small.whole());
    struct Place {
        int x, y, s;
    };
    std::vector<Place> places;
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 10; ++x)
            for (int s = 0; s < 5; ++s) {
                places.push_back({x, y, s});
                all.add(x, y, sample_of(x, y, s));
            }
    one.add(all);

    std::mt19937 random(1);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int round = 0; round < 30; ++round) {
        // Overlapping tiles, each with some of the samples in it; a film of one pixel has the remaining ones.
        std::vector<FilmTile> tiles;
        for (int i = 0; i < 8; ++i) {
            const int x = below(10), y = below(6);
            tiles.push_back(one.tile({x, y, x + 1 + below(10 - x), y + 1 + below(6 - y)}));
        }
        tiles.push_back(one.tile(small.whole()));
        std::ranges::shuffle(places, random);
        for (const Place& p : places) {
            std::size_t i = static_cast<std::size_t>(below(static_cast<int>(tiles.size())));
            const PixelRange& a = tiles[i].area();
            if (p.x < a.x0 || p.x >= a.x1 || p.y < a.y0 || p.y >= a.y1) i = tiles.size() - 1;
            tiles[i].add(p.x, p.y, sample_of(p.x, p.y, p.s));
        }
        std::ranges::shuffle(tiles, random);
        Film other(small, small.whole());
        for (const FilmTile& tile : tiles) other.add(tile);
        CHECK(equal(one, other));
    }
    for (const glm::ivec2 p : {glm::ivec2(0, 0), glm::ivec2(9, 5), glm::ivec2(4, 3)}) {
        glm::dvec3 sum(0);
        for (int s = 0; s < 5; ++s) sum += glm::dvec3(sample_of(p.x, p.y, s).radiance);
        const glm::vec3 found = one.image().pixels[static_cast<std::size_t>(p.y * 10 + p.x)];
        for (int c = 0; c < 3; ++c)
            CHECK(found[c] == doctest::Approx(static_cast<float>(sum[c] / 5.0)).epsilon(c == 2 ? 1e-6 : 1e-7));
        CHECK(one.pixels().samples(p.x, p.y) == 5);
    }
    // The comparison can fail.
    Film other(small, small.whole());
    other.add(all);
    FilmTile again = other.tile({3, 3, 4, 4});
    again.add(3, 3, {glm::vec3(1e-16f), 5});
    other.add(again);
    CHECK_FALSE(equal(one, other));
}

TEST_CASE("film: pixels without samples are black, and what is not finite is counted and leaves no trace") {
    const FilmSettings settings{.width = 3, .height = 2};
    Film film(settings, settings.whole());
    FilmTile tile = film.tile({0, 0, 2, 2});
    tile.add(1, 1, {glm::vec3(5)});
    CHECK(film.image().pixels == std::vector<glm::vec3>(6, glm::vec3(0)));
    film.add(tile);
    CHECK(film.image().pixels[4] == glm::vec3(5));
    CHECK(film.image().pixels[5] == glm::vec3(0));
    FilmTile broken = film.tile({2, 0, 3, 1});
    constexpr float infinity = std::numeric_limits<float>::infinity();
    broken.add(2, 0, {glm::vec3(2, std::numeric_limits<float>::quiet_NaN(), 4)});
    broken.add(2, 0, {glm::vec3(2, -infinity, 1e30f)});
    film.add(broken);
    CHECK(film.pixels().faults() == FilmFaults{.not_finite = 2, .too_large = 1});
    CHECK(film.image().pixels[2] == glm::vec3(2, 0, 0x1p39f + 2));
    CHECK(count_non_finite(film.image()) == 0);
}

TEST_CASE("film: a part of the picture is a crop, with the same positions of samples") {
    const FilmSettings settings{.width = 20, .height = 10, .filter = {PixelFilter::Shape::box, 0.5f}};
    const Film whole(settings, settings.whole()), part(settings, {5, 2, 9, 8});
    CHECK_FALSE(whole.image().crop);
    const Image image = part.image();
    CHECK(image.width == 4);
    CHECK(image.height == 6);
    REQUIRE(image.crop);
    CHECK(image.crop->x0 == 5);
    CHECK(image.crop->y0 == 2);
    CHECK(image.crop->display_width == 20);
    CHECK(image.crop->display_height == 10);
    CHECK(part.sample_position(6, 3, {0.25f, 1.0f - 0x1p-20f}) ==
          whole.sample_position(6, 3, {0.25f, 1.0f - 0x1p-20f}));
    CHECK(part.sample_position(6, 3, {0.25f, 0.5f}) == glm::dvec2(6.25, 3.5));
    // The default filter reaches into other pixels.
    const Film smooth(FilmSettings{}, {0, 0, 1, 1});
    CHECK(smooth.sample_position(0, 0, {0, 0.5f}).x == doctest::Approx(-1.0));
}

TEST_CASE("film: rows as bytes, and back") {
    Film film(small, {2, 1, 7, 5});
    FilmTile tile = film.tile({3, 1, 7, 4});
    std::mt19937 random(2);
    for (int i = 0; i < 100; ++i) {
        const int x = 3 + static_cast<int>(random() % 4), y = 1 + static_cast<int>(random() % 3);
        tile.add(x, y, sample_of(x, y, i));
    }
    film.add(tile);
    Film read(small, {2, 1, 7, 5});
    FilmTile rows = read.tile({2, 1, 7, 5});
    for (int y = 1; y < 5; ++y) {
        ByteWriter out;
        film.pixels().write_row(y, out);
        ByteReader in(out.bytes());
        rows.read_row(y, in);
        CHECK(in.bytes_left() == 0);
        ByteReader cut(std::span<const std::byte>(out.bytes()).first(out.bytes().size() - 1));
        FilmTile unused = read.tile({2, 1, 7, 5});
        CHECK_THROWS_AS(unused.read_row(y, cut), BytesError);
    }
    read.add(rows);
    CHECK(equal(film, read));
}

TEST_CASE("planes beside the picture become further channels, if they are chosen") {
    using Three = PlaneList<RadiancePlane, FirstPlane, PhasesPlane>;
    CHECK(Three::names == std::array<std::string_view, 3>{"beauty", "first", "phases"});
    CHECK(Three::by_default().to_string() == "101");  // the last first
    const SceneNames scene_names{{"vacuum", "glass"}, {}, {}};
    const auto image_of = [&](const Three::Choice& choice) {
        Three::Sums sums(choice, scene_names, 2);
        FilmFaults faults;
        for (std::uint32_t s = 5; s-- > 0;) sums.add(1, {glm::vec3(1, 2.0f + static_cast<float>(s), 0), s}, faults);
        Image image = black_image({.width = 2, .height = 1}, {0, 0, 2, 1}, sums.channels());
        sums.resolve(1, 5, image, 1);
        CHECK(image.pixels[0] == glm::vec3(0));
        CHECK(image.pixels[1] == glm::vec3(1, 4, 0));
        return image;
    };
    const Image all = image_of(Three::all());
    REQUIRE(all.extra_channels.size() == 4);
    CHECK(all.extra_channels[0].name == "first.Y");
    CHECK(all.extra_channels[0].values == std::vector<float>{0, 2});
    CHECK(all.extra_channels[1].name == "first.count");
    CHECK(all.extra_channels[1].values == std::vector<float>{0, 5});
    CHECK(all.extra_channels[2].name == "vacuum");
    CHECK(all.extra_channels[2].values == std::vector<float>{0, 3});
    CHECK(all.extra_channels[3].name == "glass");
    CHECK(all.extra_channels[3].values == std::vector<float>{0, 2});
    const Image some = image_of(Three::by_default());
    REQUIRE(some.extra_channels.size() == 2);
    CHECK(some.extra_channels[0].name == "vacuum");
    // The picture is always kept, and planes that are not chosen take no memory.
    CHECK(image_of({}).extra_channels.empty());
    CHECK(Three::Sums({}, scene_names, 2).bytes_of_pixel() == 48);
    CHECK(Three::Sums(Three::all(), scene_names, 2).bytes_of_pixel() == 48 + sizeof(FirstValue<1>) + 2 * sizeof(Count));
}

}  // namespace test_film
