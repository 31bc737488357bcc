// Scattering media, piece by piece: the phase function and free flights by χ², transmittances against closed forms, and
// colours that never increase.
//
// The planted defect is a skew of 1 %: the first uniform number to the power 1.01, a χ²-distance of 1e-4.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "image/luminance.hpp"
#include "media/medium.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "support/statistics.hpp"
#include "support/uniform.hpp"

namespace test_scattering {

using namespace phasetree;
using namespace phasetree::tracer;
using phasetree::tests::chi_squared_test;
using phasetree::tests::mean_p_value;
using phasetree::tests::Moments;
using phasetree::tests::samples_to_detect;
using phasetree::tests::sidak;
using phasetree::tests::Uniform;

namespace {

constexpr std::size_t cells = 64;

Sampler sampler_of(std::uint32_t i) {
    return {i & 0xffffu, i >> 16, 0, 7};
}

// A box from z = 0 to 1, in which the density rises evenly from both faces to 1 at the depth 0.25.
const Field box = Box{.size = {4, 4, 1}};
const glm::vec3 below(0, 0, -1), up(0, 0, 1);  // the box is centred
double density_at(double t) {
    const double z = t - 1;
    return std::clamp((0.5 - std::abs(z)) / 0.25, 0.0, 1.0);
}

// ∫₀ᵗ ρ along the ray from `below`, by the midpoint rule.
double depth_to(double t) {
    constexpr int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += density_at(t * (i + 0.5) / steps) * t / steps;
    return sum;
}

// Along the ray through the middle of a rotated grid, three fifths of which are empty. The density is linear between
// voxels 0.05 apart, so the trapezoidal rule is exact.
struct Column {
    static constexpr int count = 40;
    static constexpr double spacing = 0.05;
    std::array<double, count> values{};

    Column() {
        for (int i = 0; i < count; ++i) {
            const bool is_empty = i < 10 || (i >= 17 && i < 31);
            values[static_cast<std::size_t>(i)] = is_empty ? 0 : 0.25 + 0.75 * std::abs(std::sin(1.7 * i));
        }
        values[12] = 1;
        values.front() = values.back() = 0;
    }
    static Way turned_way(const VoxelPlacement& placement) {
        const glm::dvec3 from = placement.linear * glm::dvec3(0.02, -0.03, -0.5 * spacing) + placement.translation;
        return {glm::vec3(from), glm::vec3(glm::normalize(placement.linear[2])), 2.0f};
    }
    VoxelDensity density(const VoxelPlacement& placement) const {
        const VoxelLattice lattice{{3, 9, count}, {-0.1, -0.4, 0}, {0.1, 0.1, spacing}};
        return {VoxelGrid::of_voxels("test", lattice,
                                     [&](int, int, int z) { return 3 * values[static_cast<std::size_t>(z)]; }),
                placement};
    }
    double at(double t) const {
        const double u = std::clamp(t / spacing - 0.5, 0.0, count - 1.0);
        const auto i = std::min(static_cast<std::size_t>(u), std::size_t{count - 2});
        return values[i] + (u - static_cast<double>(i)) * (values[i + 1] - values[i]);
    }
    double depth_to(double t) const {
        constexpr int steps = 8000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) sum += at(t * (i + 0.5) / steps) * t / steps;
        return sum;
    }
};
const VoxelPlacement turned{glm::dmat3{{0.36, 0.48, 0.8}, {-0.8, 0.6, 0}, {-0.48, -0.64, 0.6}}, {3, -2, 1}};

const ScatteringCoefficients coloured{.absorption = glm::vec3(0.1f, 0.4f, 0.2f),
                                      .scattering = {1.9f, 0.6f, 3.8f},
                                      .emission = {0.5f, 0.2f, 0.1f},
                                      .phase_function = HenyeyGreenstein(0.3f)};

}  // namespace

TEST_CASE("Henyey-Greenstein: the density is 1 in all, its mean cosine is g, and samples follow it") {
    for (const float g : {-0.9f, -0.3f, 0.0f, 0.0005f, 0.5f, 0.95f}) {
        CAPTURE(g);
        const HenyeyGreenstein phase(g);
        // Cells of equal probability: the inverse of the cumulative distribution by fine sums of the density.
        constexpr int steps = 1 << 18;
        std::vector<double> cumulative{0};
        double mean = 0;
        for (int i = 0; i < steps; ++i) {
            const double mu = -1 + 2 * (i + 0.5) / steps;
            const double p =
                4 * 3.14159265358979324 * static_cast<double>(phase.evaluate(static_cast<float>(mu))) / steps;
            cumulative.push_back(cumulative.back() + p);
            mean += p * mu;
        }
        CHECK(cumulative.back() == doctest::Approx(1).epsilon(1e-4));
        CHECK(mean == doctest::Approx(static_cast<double>(g)).epsilon(1e-4));
        const auto test = [&](float power) {
            const std::size_t count = samples_to_detect(1e-4, cells - 1);
            std::vector<double> observed(cells), expected(cells, static_cast<double>(count) / cells);
            Uniform random(3);
            for (std::size_t n = 0; n < count; ++n) {
                glm::vec2 u = random.two();
                u.x = std::pow(u.x, power);
                const double height = 1 + static_cast<double>(phase.sample(u).z);
                const auto step = std::min(static_cast<std::size_t>(height / 2 * steps), std::size_t{steps - 1});
                const double at = cumulative[step] + (cumulative[step + 1] - cumulative[step]) *
                                                         (height / 2 * steps - static_cast<double>(step));
                ++observed[std::min(static_cast<std::size_t>(at / cumulative.back() * cells), cells - 1)];
            }
            return chi_squared_test(observed, expected).p_value;
        };
        CHECK(test(1) > 1e-4);
        CHECK(test(1.01f) < 1e-4);
    }
}

TEST_CASE("free flights: distances follow the exponential law, weighted or not") {
    // All channels are equal, so each follows the same law.
    const ScatteringCoefficients grey{.absorption = glm::vec3(0.2f), .scattering = glm::vec3(1.8f)};
    const HomogeneousMedium even(grey);
    const std::size_t count = samples_to_detect(1e-4, cells);
    const auto test_way = [&](const auto& medium, const Way& way, auto&& depth, double error) {
        const auto length = static_cast<double>(way.length);
        std::vector<double> observed(cells + 1), expected(cells + 1);
        for (std::size_t i = 0; i < cells; ++i) {
            const double a = length * static_cast<double>(i) / cells, b = length * static_cast<double>(i + 1) / cells;
            expected[i] = static_cast<double>(count) *
                          std::max(0.0, std::exp(-2 * error * depth(a)) - std::exp(-2 * error * depth(b)));
        }
        expected[cells] = static_cast<double>(count) * std::exp(-2 * error * depth(length));
        for (std::size_t n = 0; n < count; ++n) {
            Sampler sampler = sampler_of(static_cast<std::uint32_t>(n));
            const Flight flight = medium.fly(way, glm::vec3(1.0f), sampler);
            if (!flight.scattered_at)
                ++observed[cells];
            else
                ++observed[std::min(
                    static_cast<std::size_t>(static_cast<double>(*flight.scattered_at) / length * cells), cells - 1)];
        }
        return chi_squared_test(observed, expected).p_value;
    };
    const auto test = [&](const auto& medium, double length, auto&& depth, double error) {
        return test_way(medium, {below, up, static_cast<float>(length)}, depth, error);
    };
    const auto straight = [](double t) { return t; };
    CHECK(test(even, 1.5, straight, 1) > 1e-4);
    CHECK(test(even, 1.5, straight, 1.02) < 1e-4);
    const ScatteringCoefficients white{.scattering = glm::vec3(2.0f)};
    const VaryingMedium varying_white(white, FieldDensity(box, 0.25f));
    CHECK(test(varying_white, 2, depth_to, 1) > 1e-4);
    CHECK(test(varying_white, 2, depth_to, 1.02) < 1e-4);
    const Column column;
    const VaryingMedium by_voxels(white, column.density(turned));
    const auto depth_in_column = [&](double t) { return column.depth_to(t); };
    CHECK(test_way(by_voxels, Column::turned_way(turned), depth_in_column, 1) > 1e-4);
    CHECK(test_way(by_voxels, Column::turned_way(turned), depth_in_column, 1.02) < 1e-4);
}

TEST_CASE("a flight's weights: what passes, what is scattered, what shines, by channel, against closed forms") {
    constexpr std::uint32_t count = 200000;
    const glm::vec3 throughput(0.9f, 0.5f, 0.05f);
    const double significance = sidak(1e-4, 18);
    const auto test = [&](const auto& medium, const Way& way, double depth) {
        std::array<Moments, 3> passed, scattered, emitted, transmitted;
        const float before = throughput.x + throughput.y + throughput.z;
        for (std::uint32_t n = 0; n < count; ++n) {
            Sampler sampler = sampler_of(n);
            const Flight flight = medium.fly(way, throughput, sampler);
            REQUIRE(glm::dot(throughput, flight.weight) <= before * 1.0001f);
            const glm::vec3 left = medium.transmittance(way, sampler);
            for (int c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>(c);
                const auto w = static_cast<double>(flight.weight[c]);
                passed[i].add(flight.scattered_at ? 0 : w);
                scattered[i].add(flight.scattered_at ? w : 0);
                emitted[i].add(static_cast<double>(flight.emitted[c]));
                transmitted[i].add(static_cast<double>(left[c]));
            }
        }
        for (int c = 0; c < 3; ++c) {
            CAPTURE(c);
            const auto i = static_cast<std::size_t>(c);
            const auto sigma = static_cast<double>(coloured.extinction()[c]);
            const double left = std::exp(-sigma * depth), lost = (1 - left) / sigma;
            const double scattering = static_cast<double>(coloured.scattering[c]) * lost;
            const double emission = static_cast<double>(coloured.emission[c]) * lost;
            CHECK(mean_p_value(passed[i], left, 1e-5) > significance);
            CHECK(mean_p_value(scattered[i], scattering, 1e-5) > significance);
            CHECK(mean_p_value(emitted[i], emission, 1e-5) > significance);
            CHECK(mean_p_value(transmitted[i], left, 1e-5) > significance);
            // The dim channel is the noisiest.
            if (c < 2) CHECK(mean_p_value(scattered[i], 1.02 * scattering) < significance);
        }
    };
    test(HomogeneousMedium(coloured), {below, up, 1.2f}, 1.2);
    test(VaryingMedium(coloured, FieldDensity(box, 0.25f)), {below, up, 2.0f}, depth_to(2));
    const Column column;
    test(VaryingMedium(coloured, column.density(turned)), Column::turned_way(turned), column.depth_to(2));
}

// Along a path on which the temperature rises linearly, the emitted light is the integral of Planck's law. A planted
// error of 1 % of the temperature is detected.
TEST_CASE("what is hot shines by its temperature, in red, green and blue and by wavelength") {
    constexpr int count = 33;
    constexpr double hottest = 2400, reference = 2000, sigma = 1.5, length = 1.6;
    const VoxelLattice lattice{{2, 2, count}, {-0.5, -0.5, 0}, {1, 1, length / (count - 1)}};
    const auto rising = [](int, int, int z) { return 0.25 + 0.75 * z / (count - 1); };
    const VoxelDensity temperatures(VoxelGrid::of_voxels("test", lattice, rising), {});
    const VoxelDensity even(VoxelGrid::of_voxels("test", lattice, [](int, int, int) { return 1; }), {});
    const auto spectrum = std::make_shared<const LightSpectrum>(LightSpectrum::of_temperature(reference));
    const ScatteringCoefficients glowing{
        .absorption = glm::vec3(sigma), .emission = glm::vec3(2.0f), .emission_spectrum = spectrum};
    const VaryingMedium medium(glowing, even, Heat(temperatures, hottest, reference));
    const Wavelengths three = Wavelengths::three(0.2f, WavelengthDistribution());
    // 2 ∫ exp(−σ t) B(λ, T(t))/B(λ, T₀) dt times the light at T₀, of luminance 1.
    const auto expected = [&](double nanometres, double error) {
        constexpr int steps = 2000;
        double sum = 0;
        for (int i = 0; i < steps; ++i) {
            const double t = length * (i + 0.5) / steps;
            const double kelvin = hottest * (0.25 + 0.75 * t / length) * error;
            const double c2 = 1.438776877e7 / nanometres;
            sum += std::exp(-sigma * t) * std::expm1(c2 / reference) / std::expm1(c2 / kelvin) * length / steps;
        }
        return 2 * sum * static_cast<double>(spectrum->relative_at(static_cast<float>(nanometres)));
    };
    // In red, green and blue, the light of each temperature is a colour in their gamut, with the same luminance.
    const auto rgb = [&](double error) {
        constexpr int steps = 400;
        glm::dvec3 sum(0);
        for (int i = 0; i < steps; ++i) {
            const double t = length * (i + 0.5) / steps;
            const double kelvin = hottest * (0.25 + 0.75 * t / length) * error;
            const glm::dvec3 mixed = colour_of([&](double nm) {
                const double c2 = 1.438776877e7 / nm;
                return static_cast<double>(spectrum->relative_at(static_cast<float>(nm))) * std::expm1(c2 / reference) /
                       std::expm1(c2 / kelvin);
            });
            const glm::dvec3 positive = glm::max(mixed, glm::dvec3(0));
            const double kept = static_cast<double>(luminance(glm::vec3(mixed)) / luminance(glm::vec3(positive)));
            sum += std::exp(-sigma * t) * 2 * kept * positive * length / static_cast<double>(steps);
        }
        return sum;
    };
    for (const bool is_spectral : {false, true}) {
        CAPTURE(is_spectral);
        const Way way{{0, 0, 0}, up, static_cast<float>(length), is_spectral ? &three : nullptr};
        std::array<Moments, 3> passed, flown;
        for (std::uint32_t n = 0; n < 300000; ++n) {
            Sampler sampler = sampler_of(n);
            const glm::vec3 a = medium.pass(way, sampler).emitted;
            const glm::vec3 b = medium.fly(way, glm::vec3(1.0f), sampler).emitted;
            for (std::size_t c = 0; c < 3; ++c) {
                passed[c].add(static_cast<double>(a[static_cast<int>(c)]));
                flown[c].add(static_cast<double>(b[static_cast<int>(c)]));
            }
        }
        for (int c = 0; c < 3; ++c) {
            CAPTURE(c);
            const auto i = static_cast<std::size_t>(c);
            const double nanometres = static_cast<double>(three.nanometres[c]);
            const auto of = [&](double error) { return is_spectral ? expected(nanometres, error) : rgb(error)[c]; };
            const double significance = sidak(1e-4, 12);
            CHECK(mean_p_value(passed[i], of(1), 1e-5) > significance);
            CHECK(mean_p_value(flown[i], of(1), 1e-5) > significance);
            CHECK(mean_p_value(passed[i], of(1.01)) < significance);
        }
    }
    // It is as bright as Planck's law predicts.
    const Heat heat(temperatures, hottest, reference);
    CHECK(heat.luminance(static_cast<float>(reference / hottest)) == doctest::Approx(1).epsilon(1e-3));
    CHECK(heat.luminance(0) == 0.0f);
    const auto brightness = [&](double kelvin) {
        return luminance(glm::vec3(colour_of([&](double nm) {
            const double c2 = 1.438776877e7 / nm;
            return static_cast<double>(spectrum->relative_at(static_cast<float>(nm))) * std::expm1(c2 / reference) /
                   std::expm1(c2 / kelvin);
        })));
    };
    for (const float share : {0.4f, 0.5f, 0.73f, 0.9f})
        CHECK(heat.luminance(share) ==
              doctest::Approx(static_cast<double>(brightness(hottest * static_cast<double>(share)))).epsilon(2e-3));
}

TEST_CASE("shadow rays are sent to flames by their density and their heat") {
    const VoxelLattice lattice{{2, 2, 17}, {-0.5, -0.5, 0}, {1, 1, 0.125}};
    const auto rising = [](int, int, int z) { return 0.25 + 0.75 * z / 16; };
    const VoxelDensity temperatures(VoxelGrid::of_voxels("test", lattice, rising), {});
    const Heat heat(temperatures, 2000, 2000);
    const VaryingMedium medium({.absorption = glm::vec3(1.0f), .emission = glm::vec3(1.0f)}, FieldDensity(box, 0.25f),
                               heat);
    PointBatch points{};
    for (std::size_t i = 0; i < batch_size; ++i) points.z[i] = 0.05f * static_cast<float>(i);
    const BatchOfFloats brightness = medium.brightness_at(points);
    for (std::size_t i = 0; i < batch_size; ++i) {
        const double share = 0.25 + 0.75 * static_cast<double>(points.z[i]) / 2;
        const double expected = density_at(1 + static_cast<double>(points.z[i])) *
                                static_cast<double>(heat.luminance(static_cast<float>(share)));
        CHECK(static_cast<double>(brightness[i]) == doctest::Approx(expected).epsilon(1e-4));
    }
    CHECK(brightness[0] < 0.01f * heat.luminance(0.6f));
}

TEST_CASE("absorption that is so many times as dense, by colour and by wavelength") {
    const Wavelengths three = Wavelengths::three(0.3f, WavelengthDistribution());
    const auto spectrum =
        std::make_shared<const Spectrum>(std::vector<Spectrum::Point>{{400, 1}, {500, 4}, {600, 0.5f}, {700, 2}});
    const Absorption all[] = {glm::vec3(1, 2, 3), Absorption::left_after({0.2f, 0.5f, 0.8f}, 0.5f),
                              Absorption::of(spectrum)};
    for (const Absorption& one : all) {
        const Absorption denser = one.times(2).times(1.5f);
        for (const Wavelengths* const wavelengths : {static_cast<const Wavelengths*>(nullptr), &three})
            for (int c = 0; c < 3; ++c)
                CHECK(denser.for_light(wavelengths)[c] == doctest::Approx(3 * one.for_light(wavelengths)[c]));
        const glm::vec3 scattering(0.5f, 1, 0.25f);
        CHECK(denser.greatest_with(3.0f * scattering) == doctest::Approx(3 * one.greatest_with(scattering)));
    }
}

TEST_CASE("of light that hardly gets through the mean is right, and none is less than nothing") {
    // The number is 211/255 everywhere except far away. Because of rounding, 5 times that over the rate of collisions
    // is slightly more than 1.
    const VoxelLattice lattice{{32, 2, 2}, {-1, -1, -1}, {2, 2, 2}};
    const VoxelDensity even(
        VoxelGrid::of_voxels("test", lattice, [](int x, int, int) { return x < 30 ? 211.0f / 255 : 1.0f; }), {});
    const Column column;
    const auto test = [&](const VoxelDensity& density, float extinction, const Way& way, double depth) {
        const VaryingMedium medium({.absorption = glm::vec3(extinction)}, density);
        Moments left, passed;
        for (std::uint32_t n = 0; n < 400000; ++n) {
            Sampler sampler = sampler_of(n);
            const float one = medium.transmittance(way, sampler).x;
            REQUIRE(one >= 0.0f);
            REQUIRE(one <= 1.0f);
            left.add(static_cast<double>(one));
            passed.add(static_cast<double>(medium.pass(way, sampler).left.x));
        }
        const double expected = std::exp(-static_cast<double>(extinction) * depth);
        CHECK(mean_p_value(left, expected, 1e-7) > 1e-4);
        CHECK(mean_p_value(passed, expected, 1e-7) > 1e-4);
        CHECK(mean_p_value(left, 1.1 * expected) < 1e-4);
    };
    test(even, 5.0f, {glm::vec3(0, 0, -1), up, 1.2f}, 1.2 * 211 / 255);
    test(column.density(turned), 6.0f, Column::turned_way(turned), column.depth_to(2));
}

TEST_CASE("behind a block of voxels of which one is far denser there is still something") {
    // The bound on the density in the first two blocks is 10⁶, but a path beside the voxel meets nothing.
    const VoxelLattice lattice{{8, 8, 64}, {-3.5, -3.5, 0.5}, {1, 1, 1}};
    const VoxelDensity density(VoxelGrid::of_voxels("test", lattice,
                                                    [](int x, int y, int z) {
                                                        if (x == 0 && y == 0 && z == 4) return 1e6;
                                                        return z >= 32 ? 0.05 : 0.0;
                                                    }),
                               {});
    const VaryingMedium medium(ScatteringCoefficients{.absorption = glm::vec3(1.0f)}.times(density.greatest_number()),
                               density);
    Moments left;
    for (std::uint32_t n = 0; n < 300; ++n) {
        Sampler sampler = sampler_of(n);
        left.add(static_cast<double>(medium.transmittance({{2, 2, -1}, up, 80}, sampler).x));
    }
    CHECK(mean_p_value(left, std::exp(-0.05 * 32), 1e-2) > 1e-4);
}

TEST_CASE("ways without end, and through nothing") {
    Sampler sampler = sampler_of(1);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const HomogeneousMedium even(coloured);
    CHECK(even.fly({below, up, infinity}, glm::vec3(1.0f), sampler).scattered_at.has_value());
    CHECK(even.transmittance({below, up, infinity}, sampler) == glm::vec3(0.0f));
    CHECK(even.transmittance({below, up, 0}, sampler) == glm::vec3(1.0f));
    const VaryingMedium varying(coloured, FieldDensity(box, 0.25f));
    const Flight past = varying.fly({glm::vec3(3, 0, -1), up, infinity}, glm::vec3(1.0f), sampler);
    CHECK_FALSE(past.scattered_at.has_value());
    CHECK(past.weight == glm::vec3(1.0f));
    CHECK(varying.transmittance({below, -up, infinity}, sampler) == glm::vec3(1.0f));
    // One channel is neither scattered nor absorbed, and no other channel has light.
    const HomogeneousMedium one({.scattering = {0, 1, 1}});
    const Flight red = one.fly({below, up, infinity}, glm::vec3(1, 0, 0), sampler);
    CHECK_FALSE(red.scattered_at.has_value());
    CHECK(red.weight.x == 1.0f);
    CHECK(red.weight.y == 0.0f);
}

}  // namespace test_scattering
