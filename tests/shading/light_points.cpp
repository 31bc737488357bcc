// Lights without an extent, photometric files, and portals.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "light_checks.hpp"
#include "lights/lights.hpp"

namespace test_light_points {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

// A profile in two planes: c(θ) = 100 − θ/2 candelas in the first, and twice as much in the second.
const std::string file =
    "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n"
    "1 1000 2.0 3 3 1 2 0 0 0\n0.5 1 60\n0 45 90\n0 90 180\n"
    "100 77.5 55\n200, 155, 110\n100 77.5 55\n";

std::string problem_of(const std::string& text) {
    try {
        (void)IesProfile(text);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
}

// The irradiance on a surface at p with this normal, by samples of the lights; `factor` plants a defect.
double irradiance(const Lights& lights, const glm::vec3& p, const glm::vec3& normal, float factor = 1.0f) {
    Moments moments;
    Uniform random(3);
    for (int i = 0; i < 2000; ++i) {
        const auto sample = lights.sample(p, random.two());
        if (sample)
            moments.add(static_cast<double>(factor * sample->radiance.x * std::max(0.0f, glm::dot(sample->wi, normal)) /
                                            sample->pdf));
        else
            moments.add(0.0);
    }
    return moments.mean();
}

}  // namespace

TEST_CASE("point light: the irradiance of the inverse square, alone and among others") {
    Lights lights;
    lights.add(AnyPointLight(PointLight({0, 0, 3}, glm::vec3(20.0f))));
    const double expected = 20.0 * 3.0 / std::pow(9.0 + 16.0, 1.5);  // I cos θ/d²
    CHECK(irradiance(lights, {4, 0, 0}, {0, 0, 1}) == doctest::Approx(expected).epsilon(1e-5));
    CHECK_FALSE(irradiance(lights, {4, 0, 0}, {0, 0, 1}, 1.01f) == doctest::Approx(expected).epsilon(1e-3));
    CHECK_FALSE(lights.empty());
    CHECK(lights.pdf(glm::vec3(4, 0, 0), {0, 0, 1}) == 0.0f);  // no other technique finds it
    CHECK_FALSE(lights.seen({0, 0, 0}, {0, 0, 1}, 10.0f, true));
    lights.add(AnyPointLight(PointLight({0, 0, 3}, glm::vec3(40.0f))));
    const auto sample = lights.sample(glm::vec3(4, 0, 0), {0.1f, 0.5f});
    REQUIRE(sample);
    CHECK(sample->is_of_point_light());
    CHECK(sample->distance == 5.0f);
    CHECK(irradiance(lights, {4, 0, 0}, {0, 0, 1}) == doctest::Approx(3 * expected).epsilon(1e-4));
}

TEST_CASE("point light: what it brings belongs to its group") {
    Lights lights;
    lights.add(AnyPointLight(PointLight({0, 0, 3}, glm::vec3(20.0f))), "left");
    lights.add(AnyPointLight(PointLight({0, 0, 3}, glm::vec3(60.0f))), "right");
    std::vector<glm::vec3> groups(lights.groups().size());
    for (const float u : {0.1f, 0.9f}) {
        const auto sample = lights.sample(glm::vec3(0, 0, 0), {u, 0.5f});
        REQUIRE(sample);
        lights.add_to_groups(glm::vec3(1.0f), nullptr, sample->source, sample->wi, groups);
    }
    CHECK(groups == std::vector<glm::vec3>{glm::vec3(0.0f), glm::vec3(1.0f), glm::vec3(1.0f)});
}

TEST_CASE("spot light: its flux, its edge and its dark side") {
    const SpotLight spot({0, 0, 0}, {0, 0, -2}, 60.0f, 10.0f, glm::vec3(5.0f));
    CHECK(spot.intensity({0, 0, -1}).x == 5.0f);
    CHECK(spot.intensity({0, 0, 1}).x == 0.0f);
    const auto at = [&](double degrees) {
        const double a = degrees * std::numbers::pi / 180.0;
        return static_cast<double>(
            spot.intensity({static_cast<float>(std::sin(a)), 0.0f, static_cast<float>(-std::cos(a))}).x);
    };
    CHECK(at(19.9) == doctest::Approx(5.0).epsilon(1e-5));
    CHECK(at(30.1) == 0.0);
    CHECK(at(25.0) > 1.0);
    CHECK(at(25.0) < 4.0);
    // ∫ I dω = 2π I ((1 − c₂) + (c₂ − c₁)/2), with the cosines of the angles at which the edge begins and ends.
    double flux = 0.0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double a = (i + 0.5) * 40.0 / steps;
        flux += at(a) * 2 * std::numbers::pi * std::sin(a * std::numbers::pi / 180.0) * 40.0 / steps *
                std::numbers::pi / 180.0;
    }
    const double c1 = std::cos(std::numbers::pi / 6), c2 = std::cos(std::numbers::pi / 9);
    const double expected = 2 * std::numbers::pi * 5.0 * ((1 - c2) + 0.5 * (c2 - c1));
    CHECK(flux == doctest::Approx(expected).epsilon(1e-4));
    CHECK_FALSE(1.01 * flux == doctest::Approx(expected).epsilon(1e-3));
}

TEST_CASE("photometric files: between their angles candelas are linear, and planes are repeated") {
    const IesProfile profile(file);
    CHECK(profile.greatest_candelas() == 200.0);  // 200 · 2.0 · 0.5
    CHECK(profile.relative_intensity(0, 0) == doctest::Approx(0.5));
    CHECK(profile.relative_intensity(45, 90) == doctest::Approx(0.775));
    CHECK(profile.relative_intensity(20, 0) == doctest::Approx(0.45));
    CHECK(profile.relative_intensity(0, 45) == doctest::Approx(0.75));
    CHECK(profile.relative_intensity(0, 315) == doctest::Approx(0.75));  // the other half is its mirror image
    CHECK(profile.relative_intensity(0, -45) == doctest::Approx(0.75));
    CHECK(profile.relative_intensity(90.5, 0) == 0.0f);
    // On a floor below, straight down and at 45°.
    Lights lights;
    lights.add(
        AnyPointLight(IesLight({0, 0, 2}, {0, 0, 0}, 0.0f, std::make_shared<const IesProfile>(file), glm::vec3(8.0f))));
    CHECK(irradiance(lights, {0, 0, 0}, {0, 0, 1}) == doctest::Approx(8.0 * 0.5 / 4).epsilon(1e-5));
    const double slant = std::sqrt(0.5) / 8;
    CHECK(irradiance(lights, {2, 0, 0}, {0, 0, 1}) == doctest::Approx(8.0 * 0.3875 * slant).epsilon(1e-4));
    CHECK(irradiance(lights, {0, 2, 0}, {0, 0, 1}) == doctest::Approx(8.0 * 0.775 * slant).epsilon(1e-4));
    CHECK_FALSE(irradiance(lights, {0, 2, 0}, {0, 0, 1}, 1.01f) == doctest::Approx(8.0 * 0.775 * slant).epsilon(1e-3));
}

TEST_CASE("photometric files: the planes that are not there are mirror images of those that are") {
    const auto profile_of = [](const std::string& horizontals, const std::string& candelas) {
        const auto count = 1 + std::ranges::count(horizontals, ' ');
        return IesProfile("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 " + std::to_string(count) +
                          " 1 2 0 0 0\n1 1 100\n0 90\n" + horizontals + "\n" + candelas);
    };
    const IesProfile quarter = profile_of("0 30 90", "1 1  2 2  8 8"), half = profile_of("0 60 180", "1 1  4 4  8 8"),
                     whole = profile_of("0 90 360", "2 2  8 8  2 2"), round = profile_of("0", "8 4");
    struct Case {
        double angle, in_quarter, in_half, in_whole;
    };
    for (const Case& c :
         {Case{0, 1, 1, 2}, Case{30, 2, 2.5, 4}, Case{60, 5, 4, 6}, Case{120, 5, 6, 8 - 6 * 30.0 / 270},
          Case{150, 2, 7, 8 - 6 * 60.0 / 270}, Case{180, 1, 8, 8 - 6 * 90.0 / 270},
          Case{210, 2, 7, 8 - 6 * 120.0 / 270}, Case{300, 5, 4, 8 - 6 * 210.0 / 270},
          Case{330, 2, 2.5, 8 - 6 * 240.0 / 270}, Case{-30, 2, 2.5, 8 - 6 * 240.0 / 270}, Case{390, 2, 2.5, 4}}) {
        CAPTURE(c.angle);
        CHECK(8 * quarter.relative_intensity(45, c.angle) == doctest::Approx(c.in_quarter));
        CHECK(8 * half.relative_intensity(45, c.angle) == doctest::Approx(c.in_half));
        CHECK(8 * whole.relative_intensity(45, c.angle) == doctest::Approx(c.in_whole));
        CHECK(8 * round.relative_intensity(45, c.angle) == doctest::Approx(6));
    }
}

TEST_CASE("photometric files: what is wrong is said with its line") {
    const auto says = [](const std::string& text, const std::string& part) {
        const std::string problem = problem_of(text);
        CAPTURE(problem);
        return problem.find(part) != std::string::npos;
    };
    CHECK(says("", "no line TILT"));
    CHECK(says(std::string(100000, 'x'), "no line TILT"));
    CHECK(says(replaced(file, "TILT=NONE", "TILT=lamp.tlt"), "line 3: TILT must be NONE or INCLUDE"));
    CHECK(says(replaced(file, "2.0", "two"), "line 4: the candela multiplier must be a number"));
    CHECK(says(replaced(file, "3 3 1 2", "3 3 2 2"), "which is B"));
    CHECK(says(replaced(file, "3 3 1 2", "3 1e9 1 2"), "whole number from 1 to 1441"));
    CHECK(says(replaced(file, "0 45 90", "0 45 45"), "must increase, but 45 follows 45"));
    CHECK(says(replaced(file, "0 90 180", "0 90 270"), "0, 90, 180 or 360"));
    CHECK(says(replaced(file, "200, 155", "-200, 155"), "must not be negative"));
    CHECK(says(replaced(file, "55\n200", "nan\n200"), "must be a number"));
    CHECK(says(file.substr(0, file.size() - 20), "the file ends before the candelas"));
    CHECK(says(replaced(file, "2.0 3", "0 3"), "must be positive"));
    CHECK(problem_of(file).empty());
    // Tilts of the lamp are skipped.
    CHECK(problem_of(replaced(file, "TILT=NONE", "TILT=INCLUDE\n1\n2\n0 90\n1 0.9")).empty());
}

TEST_CASE("photometric files: the headings of all standards are read, however TILT is written and lines end") {
    const std::string numbers = file.substr(file.find("1 1000"));
    const std::string include = "\n1\n2\n0 90\n1 0.9\n";
    const std::vector<std::string> headings{"",
                                            "A LUMINAIRE, 1986\nTILT of the lamp: none\n\n",
                                            "IESNA91\n[TEST] 1\n[MANUFAC] A. Smith\n[MORE] TILT=INCLUDE\n",
                                            "IESNA:LM-63-1995\n[TEST] 1\n[BLOCK]\n[ENDBLOCK]\n",
                                            "IESNA:LM-63-2002\n[TEST] 1\n_TILT=3\n",
                                            "IES:LM-63-2019\n[TEST] 1\n",
                                            "iesna:lm-63-2002\n[test] 1\n"};
    const std::vector<std::string> tilts{"TILT=NONE\n",
                                         "Tilt=None\n",
                                         "tilt=none\n",
                                         "TILT = NONE\n",
                                         " \tTILT\t= NONE \n",
                                         "TILT= none  \n",
                                         "TILT=NONE\n\n",
                                         "TILT=INCLUDE" + include,
                                         "tilt = Include " + include};
    for (const std::string& heading : headings)
        for (const std::string& tilt : tilts)
            for (const std::string end : {"\n", "\r\n", "\r"})
                for (const std::string mark : {"", "\xef\xbb\xbf"}) {
                    std::string text = mark;
                    for (const char c : heading + tilt + numbers) text += c == '\n' ? end : std::string(1, c);
                    CAPTURE(text);
                    CHECK(problem_of(text) == "");
                    CHECK((problem_of(text) != "" || IesProfile(text).greatest_candelas() == 200.0));
                    // The line number does not depend on the line endings.
                    const auto lines = std::ranges::count(heading + tilt, '\n');
                    CHECK(problem_of(replaced(text, "1 1000", "one 1000")) ==
                          "line " + std::to_string(lines + 1) + ": the number of lamps must be a number");
                }
    CHECK(problem_of(replaced(file, "TILT=NONE", "TILT NONE")).starts_with("it has no line TILT="));
    CHECK(problem_of(replaced(file, "TILT=NONE", "TILTED=NONE")).starts_with("it has no line TILT="));
    CHECK(problem_of(replaced(file, "TILT=NONE", "tilt = lamp.tlt")).starts_with("line 3: TILT must be NONE or"));
}

TEST_CASE("photometric files: surplus numbers and decimal commas are refused, and other text at the end is not") {
    CHECK(problem_of(file + "\x1a") == "");
    CHECK(problem_of(file + "\n end of file 1\n") == "");
    const std::string surplus =
        "a number follows the last of the candelas, so there are more numbers than the file says";
    CHECK(problem_of(file + "7\n") == "line 11: " + surplus);
    CHECK(problem_of(file + "1e999\n") == "line 11: " + surplus);
    const std::string points = "; a comma separates numbers, so write decimal points";
    CHECK(problem_of(replaced(file, "100 77.5 55", "100 77,5 55")) == "line 10: " + surplus + points);
    CHECK(problem_of(replaced(file, "0.5 1 60", "0,5 1 60")).ends_with(points));
    CHECK(problem_of(replaced(file, "2.0 3", "2,0 3")).ends_with(points));
    // Commas may separate all numbers.
    std::string commas = file.substr(file.find("1 1000"));
    std::ranges::replace(commas, ' ', ',');
    CHECK(problem_of(file.substr(0, file.find("1 1000")) + commas) == "");
    CHECK(problem_of(file.substr(0, file.find("1 1000")) + commas + ",7") == "line 11: " + surplus);
}

TEST_CASE("photometric files: candelas that overflow are not called negative") {
    CHECK(problem_of(replaced(file, "1000 2.0", "1000 1e308")) ==
          "line 10: the candelas times 5e+307, the product of their multiplier and the factor of the ballast, are too "
          "large");
    CHECK(problem_of(replaced(file, "77.5", "-77.5")).find("candelas must not be negative") != std::string::npos);
}

TEST_CASE("photometric files: random changes give a light or a reason") {
    std::mt19937 random(4);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    const std::string bytes = "0123456789.,-+eE \n\r\t=TILTNOEinfa\xff";
    int read = 0, refused = 0;
    for (int i = 0; i < 20000; ++i) {
        std::string text = file;
        for (std::size_t changes = 1 + below(6); changes > 0 && !text.empty(); --changes) {
            const std::size_t at = below(text.size());
            switch (below(4)) {
                case 0:
                    text[at] = bytes[below(bytes.size())];
                    break;
                case 1:
                    text.insert(at, 1, bytes[below(bytes.size())]);
                    break;
                case 2:
                    text.erase(at, 1 + below(8));
                    break;
                default:
                    text.insert(at, text.substr(below(text.size()), 12));
            }
        }
        try {
            const IesProfile profile(text);
            for (const double vertical : {0.0, 33.0, 90.0, 180.0})
                for (const double horizontal : {-180.0, 0.0, 77.0, 180.0, 360.0}) {
                    const float relative = profile.relative_intensity(vertical, horizontal);
                    REQUIRE((relative >= 0.0f && relative <= 1.0f));
                }
            ++read;
        } catch (const std::runtime_error& e) {
            REQUIRE(*e.what() != '\0');
            ++refused;
        }
    }
    CHECK(read > 1000);
    CHECK(refused > 1000);
}

TEST_CASE("portals: directions follow the density of the whole mixture, and an error of 1 % is seen") {
    Lights lights;
    lights.add(InfiniteLight(ConstantEnvironment(glm::vec3(1.0f))));
    lights.add(Portal(RectangleLight::facing({0, 0, 2}, {0, 0, 0}, 2.0f, 1.0f, glm::vec3(0.0f), false)));
    const glm::vec3 p(0.3f, -0.2f, 0.0f);
    constexpr int columns = 16, rows = 8;
    const auto probability = lat_long_probabilities(
        columns, rows, 64, [&](const glm::vec3& w) { return static_cast<double>(lights.pdf(p, w)); });
    CHECK(sum_of(probability) == doctest::Approx(1.0).epsilon(2e-3));
    const auto sample = [&](const glm::vec2& u) -> std::optional<glm::vec3> {
        const auto s = lights.sample(p, u);
        if (!s) return std::nullopt;
        return s->wi;
    };
    // The edge of the portal is not on the lattice, so the cells that it crosses are tested by the estimator below.
    int through = 0;
    Uniform random(9);
    for (int i = 0; i < 40000; ++i) {
        const auto w = sample(random.two());
        REQUIRE(w);
        through += w->z > 0 && std::abs(p.x + 2 * w->x / w->z) < 1 && std::abs(p.y + 2 * w->y / w->z) < 0.5f;
    }
    const double solid_angle = RectangleLight::facing({0, 0, 2}, {0, 0, 0}, 2.0f, 1.0f, glm::vec3(0.0f)).solid_angle(p);
    const double expected = 0.75 + 0.25 * solid_angle / (4 * std::numbers::pi);
    CHECK(through / 40000.0 == doctest::Approx(expected).epsilon(0.02));
    // The irradiance of a white sky is π, whichever technique proposes the directions.
    check(estimator_test(std::numbers::pi, 2000000, [&](Uniform& uniform) {
        const auto s = lights.sample(p, uniform.two());
        return s ? static_cast<double>(s->radiance.x * std::max(0.0f, s->wi.z) / s->pdf) : 0.0;
    }));
    // sample() and pdf() agree about a direction.
    for (int i = 0; i < 1000; ++i) {
        const auto s = lights.sample(p, random.two());
        REQUIRE(s);
        CHECK(s->pdf == doctest::Approx(lights.pdf(p, s->wi)).epsilon(1e-4));
    }
    // From behind, the portal has no effect.
    CHECK(lights.pdf(glm::vec3(0, 0, 5), {0, 0, -1}) == doctest::Approx(1 / (4 * std::numbers::pi)));
}

}  // namespace test_light_points
