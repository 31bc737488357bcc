// The film: tiles that are merged in any order, the values that planes record, and crops.
#include "film/film.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

using namespace phasetree::tracer;

namespace {

// The greatest radiance of any sample, and their number: two channels of a layer.
struct GreatestPlane {
    struct Sum {
        float greatest = 0;
        int count = 0;
        bool operator==(const Sum&) const = default;
    };
    static constexpr std::array<std::string_view, 2> channels{"greatest.Y", "greatest.count"};

    static void add(Sum& sum, const FilmSample& sample) {
        sum.greatest = std::max(sum.greatest, sample.radiance.g);
        ++sum.count;
    }
    static std::array<float, 2> resolve(const Sum& sum, int) { return {sum.greatest, static_cast<float>(sum.count)}; }
};

// A plane whose values are fewer than its channels.
struct WrongPlane : GreatestPlane {
    static std::array<float, 1> resolve(const Sum&, int) { return {0}; }
};

static_assert(PlaneKind<RadiancePlane> && PlaneKind<GreatestPlane> && !PlaneKind<WrongPlane> && !PlaneKind<int>);

// Sums of which in floats would depend on the order: the value of sample s of a pixel.
FilmSample sample_of(int x, int y, int s) {
    const float value = 1.0f / static_cast<float>(3 + 7 * x + 11 * y + 13 * s);
    return {{value, 1e10f * value, 1e-10f * value}};
}

}  // namespace

TEST_CASE("film: tiles may be merged in any order, over several passes") {
    const FilmSettings settings{.width = 10, .height = 6};
    const PixelRange left{0, 0, 4, 6}, right{4, 0, 10, 6};
    Film one(settings, settings.whole()), other(settings, settings.whole());
    const auto add = [](Film& film, const PixelRange& part, int first, int last) {
        FilmTile tile = film.tile(part);
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x)
                for (int s = first; s < last; ++s) tile.add(x, y, sample_of(x, y, s));
        return tile;
    };
    one.merge(add(one, settings.whole(), 0, 5));
    for (const auto& [first, last] : {std::pair(0, 1), std::pair(1, 5)}) {
        const FilmTile a = add(other, left, first, last), b = add(other, right, first, last);
        other.merge(b);
        other.merge(a);
    }
    const Image expected = one.image(), found = other.image();
    CHECK(found.pixels == expected.pixels);
    for (const glm::ivec2 p : {glm::ivec2(0, 0), glm::ivec2(9, 5), glm::ivec2(4, 3)}) {
        glm::dvec3 sum(0);
        for (int s = 0; s < 5; ++s) sum += glm::dvec3(sample_of(p.x, p.y, s).radiance);
        CHECK(found.pixels[static_cast<std::size_t>(p.y * 10 + p.x)] == glm::vec3(sum / 5.0));
    }
}

TEST_CASE("film: a tile that is not merged changes nothing, and pixels without samples are black") {
    const FilmSettings settings{.width = 3, .height = 2};
    Film film(settings, settings.whole());
    FilmTile dropped = film.tile({0, 0, 2, 2});
    dropped.add(1, 1, {glm::vec3(5)});
    CHECK(film.image().pixels == std::vector<glm::vec3>(6, glm::vec3(0)));
    film.merge(dropped);
    CHECK(film.image().pixels[4] == glm::vec3(5));
    CHECK(film.image().pixels[5] == glm::vec3(0));
    CHECK(count_non_finite(film.image()) == 0);
    FilmTile broken = film.tile({2, 0, 3, 1});
    broken.add(2, 0, {glm::vec3(0, std::numeric_limits<float>::quiet_NaN(), 0)});
    film.merge(broken);
    CHECK(count_non_finite(film.image()) == 1);
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

TEST_CASE("planes beside the picture become further channels") {
    using Two = PlaneList<RadiancePlane, GreatestPlane>;
    Two::Sums sums{};
    for (int s = 0; s < 4; ++s) Two::add(sums, {glm::vec3(1, static_cast<float>(s % 3), 0)});
    Image image = Two::image(2, 1);
    REQUIRE(image.further.size() == 2);
    CHECK(image.further[0].name == "greatest.Y");
    CHECK(image.further[1].name == "greatest.count");
    Two::resolve(sums, 4, image, 1);
    CHECK(image.pixels[0] == glm::vec3(0));
    CHECK(image.pixels[1] == glm::vec3(1, 0.75f, 0));
    CHECK(image.further[0].values == std::vector<float>{0, 2});
    CHECK(image.further[1].values == std::vector<float>{0, 4});
    CHECK(count_non_finite(image) == 0);
    image.further[1].values[0] = std::numeric_limits<float>::infinity();
    CHECK(count_non_finite(image) == 1);
}
