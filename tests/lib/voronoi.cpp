// The assumption of the Voronoi nodes: that the sites they consider are sufficient.

#include <doctest/doctest.h>

#include "phasetree/nodes/fields/voronoi_sites.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra/patterns.hpp"

namespace test_voronoi {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("sites that are ignored are as far as is said, and the nearest is as near") {
    Random rng(41);
    for (int n = 0; n < 2000; ++n) {
        const VoronoiSites sites{rng.chance(0.3) ? 1.f : rng.uniform(0, 1), static_cast<float>(rng.below(289))};
        const glm::dvec3 p(rng.uniform(-50, 50), rng.uniform(-50, 50), rng.uniform(-50, 50));
        const auto seen = oracle::sites(p, sites.jitter, sites.seed),
                   all = oracle::sites(p, sites.jitter, sites.seed, 3);
        REQUIRE(seen.front().at == all.front().at);
        CHECK(glm::length(seen.front().at - p) <= static_cast<double>(sites.nearest()));
        std::size_t farther = 0;
        for (const oracle::Site& s : all) farther += glm::length(s.at - p) >= static_cast<double>(sites.unseen());
        CHECK(farther >= all.size() - seen.size());
        for (const oracle::Site& s : all) {
            const glm::dvec3 cubes = glm::abs(glm::floor(s.at) - glm::floor(p));
            if (std::max({cubes.x, cubes.y, cubes.z}) > 2.5)
                REQUIRE(glm::length(s.at - p) >= static_cast<double>(sites.unseen()) - 1e-9);
        }
    }
}

TEST_CASE("the library's sites are those of the reference") {
    Random rng(42);
    for (int n = 0; n < 500; ++n) {
        const VoronoiSites sites{rng.uniform(0, 1), static_cast<float>(rng.below(289))};
        const glm::vec3 p(rng.uniform(-400, 400), rng.uniform(-400, 400), rng.uniform(-400, 400));
        std::vector<glm::dvec3> found;
        sites.for_each(Vec3<float>{p.x, p.y, p.z}, [&](const Vec3<float>& offset, float hash) {
            found.emplace_back(glm::dvec3(offset.x, offset.y, offset.z) + glm::dvec3(p));
            CHECK((hash >= 0 && hash <= 288 && hash == std::floor(hash)));
        });
        const auto expected = oracle::sites(glm::dvec3(p), sites.jitter, sites.seed);
        REQUIRE(found.size() == expected.size());
        for (const oracle::Site& s : expected)
            REQUIRE(std::any_of(found.begin(), found.end(),
                                [&](const glm::dvec3& v) { return glm::length(v - s.at) < 1e-4; }));
    }
}

}  // namespace test_voronoi
