// Numbers at voxels in scene files: what is rejected, with its position, and how densities and temperatures use the
// numbers.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "image/luminance.hpp"
#include "media/medium.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/read_parts.hpp"

namespace test_voxels_of_scenes {

using namespace phasetree;
using namespace phasetree::tracer;

namespace {

// A folder with an image of 2 × 1 pixels, 51 and 102 of 255, so 0.2 and 0.4.
struct Folder {
    support::TemporaryDirectory directory;

    Folder() { support::write_text(directory / "a.pgm", std::string("P5 2 1 255\n\x33\x66")); }

    // A clear material with these members, where IMAGE is replaced by the members that name the image.
    Medium medium(std::string members) const {
        const std::string image = R"("file": "a.pgm", "spacing": [1, 1, 1])";
        for (std::size_t at; (at = members.find("IMAGE")) != std::string::npos;) members.replace(at, 5, image);
        const std::string text = R"({"clear": {"ior": 1, )" + members + "}}";
        const Document document = Document::from_text(text, (directory / "scene.json").string());
        return std::get<Clear>(read_material(document, document.root())).interior;
    }
    std::string said_of(const std::string& members) const {
        try {
            (void)medium(members);
        } catch (const SceneError& e) {
            return fmt::format("{}: {}", e.column(), e.message());
        }
        return "nothing";
    }
};

glm::vec3 transmittance_along(const Medium& medium, const glm::vec3& from, const glm::vec3& to) {
    glm::dvec3 sum(0);
    constexpr std::uint32_t count = 4096;
    for (std::uint32_t n = 0; n < count; ++n) {
        Sampler sampler(n, 0, 0, 3);
        sum += glm::dvec3(transmittance(medium, {from, glm::normalize(to - from), glm::length(to - from)}, sampler));
    }
    return glm::vec3(sum / static_cast<double>(count));
}

}  // namespace

TEST_CASE("coefficients are multiples of the numbers, whatever the greatest of them is") {
    const Folder folder;
    const Medium medium = folder.medium(
        R"("absorption": [1, 2, 0], "scattering": [0.5, 0, 0], "emission": [3, 1, 0], "density_grid": {IMAGE, "factor": 10})");
    // Where it is densest: 0.4 times 10.
    CHECK(extinction(medium).x == doctest::Approx(6));
    CHECK(extinction(medium).y == doctest::Approx(8));
    CHECK(emission(medium).x == doctest::Approx(12));
    // Through the voxel on the left at x = −0.5, straight down: 0.2 · 10 over a metre.
    const glm::vec3 left = transmittance_along(medium, {-0.5f, 0, 2}, {-0.5f, 0, -2});
    CHECK(left.x == doctest::Approx(std::exp(-3.0)).epsilon(0.05));
    CHECK(left.y == doctest::Approx(std::exp(-4.0)).epsilon(0.05));
    CHECK(left.z == 1.0f);
    // Twice as large, and moved to the other side of the origin by a half turn.
    const Medium turned =
        folder.medium(R"("absorption": [1, 1, 1], "density_grid": {IMAGE, "scale": 2, "rotate_z": 180})");
    CHECK(transmittance_along(turned, {1, 0, 3}, {1, 0, -3}).x == doctest::Approx(std::exp(-0.4)).epsilon(0.01));
    CHECK(transmittance_along(turned, {-1, 0, 3}, {-1, 0, -3}).x == doctest::Approx(std::exp(-0.8)).epsilon(0.01));
    // Absorption after a distance, and by wavelength, is multiplied, too.
    const Medium coloured =
        folder.medium(R"("color": [0.5, 0.5, 0.5], "color_distance": 0.2, "density_grid": {IMAGE, "factor": 2.5})");
    CHECK(extinction(coloured).x == doctest::Approx(std::log(2.0) / 0.2));
    const Medium nothing = folder.medium(R"("absorption": [1, 1, 1], "density_grid": {IMAGE, "factor": 0})");
    CHECK(transmittance_along(nothing, {-0.5f, 0, 2}, {-0.5f, 0, -2}) == glm::vec3(1));
}

TEST_CASE("a grid is made larger first, then turned, then moved; with y up what is up in the file is up") {
    const Folder folder;
    // The dense voxel is at (0.5, 0, 0) in the file.
    const auto density_at = [&](const std::string& placement, const glm::vec3& p) {
        const Medium medium = folder.medium(R"("absorption": [1, 1, 1], "density_grid": {IMAGE, )" + placement + "}");
        PointBatch points;
        for (std::size_t i = 0; i < batch_size; ++i) points.x[i] = p.x, points.y[i] = p.y, points.z[i] = p.z;
        return std::get<VaryingMedium>(medium).brightness_at(points)[0];
    };
    // Scaled by three it is at (1.5, 0, 0), after a quarter turn from x to y at (0, 1.5, 0), and then it is moved.
    const std::string quarter = R"("scale": 3, "rotate_z": 90, "translate": [10, 20, 30])";
    CHECK(density_at(quarter, {10, 21.5f, 30}) == doctest::Approx(1).epsilon(1e-5));
    CHECK(density_at(quarter, {10, 18.5f, 30}) == doctest::Approx(0.5).epsilon(1e-5));
    CHECK(density_at(quarter, {11.4f, 22.9f, 31.4f}) > 0.9f);
    CHECK(density_at(quarter, {10, 23.1f, 30}) == 0.0f);
    // The file's y is the scene's z, and its z is the scene's −y. Because the voxels are 1 × 1 × 1, only the box shows
    // this.
    const std::string flat = R"("y_up": true, "rotate_z": 90, "scale": 2)";
    CHECK(density_at(flat, {0.9f, 1, 0.9f}) > 0.9f);
    CHECK(density_at(R"("y_up": true)", {0.5f, 0, 0}) == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("what is cold does not shine, and what is no temperature is rejected") {
    const Folder folder;
    const auto hot = [](double factor) {
        return fmt::format(R"("absorption": [1, 1, 1], "emission": [5, 5, 5], "density_grid": {{IMAGE}}, )"
                           R"("temperature_grid": {{IMAGE, "factor": {}}})",
                           factor);
    };
    CHECK(is_emissive(folder.medium(hot(5000))));
    CHECK(emission_spectrum(folder.medium(hot(5000))) != nullptr);
    // In a film, the same temperature has the same brightness, whatever the hottest temperature is.
    const auto light = [&](double factor) {
        const Medium medium = folder.medium(hot(factor));
        PointBatch points{};
        for (std::size_t i = 0; i < batch_size; ++i) points.x[i] = i % 2 == 0 ? 0.5f : -0.5f;
        const BatchOfFloats brightness = std::get<VaryingMedium>(medium).brightness_at(points);
        return std::pair(brightness[0], 2 * brightness[1]);  // of densities 1 and 1/2
    };
    CHECK(light(5000).first == doctest::Approx(1).epsilon(1e-3));    // 2000 K
    CHECK(light(10000).second == doctest::Approx(1).epsilon(1e-3));  // 2000 K beside 4000 K
    CHECK(light(3000).first == doctest::Approx(light(6000).second).epsilon(1e-3));
    CHECK(light(750).first < 1e-12f);                 // 300 K
    CHECK_FALSE(is_emissive(folder.medium(hot(0))));  // a frame in which nothing burns
    CHECK(folder.said_of(hot(1)).find("its highest temperature would be 0.4 K; use \"factor\" to convert") !=
          std::string::npos);
    std::string bright = hot(2e5) + R"(, "emission_temperature": 500)";
    bright.replace(bright.find("[5, 5, 5]"), 9, "[5e5, 5e5, 5e5]");
    CHECK(folder.said_of(bright).find("the emission of the densest and hottest part exceeds 10²⁵") !=
          std::string::npos);
    CHECK(folder.said_of(hot(1e7)).find("its highest temperature would be 4e+06 K") != std::string::npos);
}

TEST_CASE("what is hot shines in proportion to its density") {
    const Folder folder;
    // The left voxel has 2000 K, at which the medium of density 1 emits 5 a metre, and a density of 0.2. Absorption is
    // negligible.
    const Medium medium = folder.medium(
        R"("absorption": [1e-3, 1e-3, 1e-3], "emission": [5, 5, 5], "density_grid": {IMAGE}, "temperature_grid": {IMAGE, "factor": 10000})");
    double sum = 0;
    constexpr std::uint32_t count = 4096;
    for (std::uint32_t n = 0; n < count; ++n) {
        Sampler sampler(n, 0, 0, 3);
        const Way straight_down{{-0.5f, 0, 2}, {0, 0, -1}, 4};
        sum += static_cast<double>(luminance(pass(medium, straight_down, sampler).emitted));
    }
    CHECK(sum / count == doctest::Approx(5 * 0.2).epsilon(0.05));
}

TEST_CASE("what does not go together is said at its place") {
    const Folder folder;
    const auto is_said = [&](const std::string& members, const std::string& what) {
        const std::string said = folder.said_of(members);
        CAPTURE(said);
        CHECK(said.find(what) != std::string::npos);
    };
    const std::string absorbs = R"("absorption": [1, 1, 1], )";
    is_said(absorbs + R"("density_grid": {"file": "a.pgm"})", "needs \"spacing\"");
    is_said(absorbs + R"("density_grid": {"file": "a.vdb", "spacing": [1, 1, 1]})",
            "81: OpenVDB grids have their own spacing; remove \"spacing\"");
    is_said(absorbs + R"("density_grid": {IMAGE, "grid": "smoke"})", "images have no named grids; remove \"grid\"");
    is_said(absorbs + R"("density_grid": {"file": "b.pgm", "spacing": [1, 1, 1]})", "72: cannot use the voxels");
    is_said(R"("density_grid": {IMAGE})", "\"density_grid\" requires \"scattering\" or \"absorption\"");
    is_said(absorbs + R"("density": {"sphere": {"radius": 1}}, "density_depth": 1, "density_grid": {IMAGE})",
            "\"density_grid\" and \"density\" cannot be combined");
    is_said(absorbs + R"("density_grid": {IMAGE}, "temperature_grid": {IMAGE})", "requires \"emission\"");
    is_said(absorbs + R"("emission": [1, 1, 1], "temperature_grid": {IMAGE})",
            "requires \"density_grid\" or \"density\"");
    is_said(absorbs + R"("emission": [1, 1, 1], "emission_spectrum": {"blackbody": 2000}, "density_grid": {IMAGE},
                         "temperature_grid": {IMAGE})",
            "\"temperature_grid\" and \"emission_spectrum\" cannot be combined");
    is_said(absorbs + R"("density_grid": {IMAGE, "translate": [1e30, 0, 0]})",
            "its voxels are too small for their distance");
    is_said(absorbs + R"("density_grid": {IMAGE, "translate": [1e7, 0, 0]})",
            "its voxels are too small for their distance");
    is_said(absorbs + R"("density_grid": {IMAGE, "scale": 1.2e-38, "translate": [10, 10, 10]})",
            "too small for their distance");
    is_said(absorbs + R"("density_grid": {IMAGE, "scale": 1e20})",
            "its voxels would be farther than 10¹⁵ from the origin");
    is_said(absorbs + R"("density_grid": {IMAGE, "factor": 1e38})",
            "the absorption and scattering of the densest part exceed 10¹⁵ per metre");
}

}  // namespace test_voxels_of_scenes
