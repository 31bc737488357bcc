// Meshes whose lines go through cells in Embree are those of the whole program's lines.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "embree_core/line_tracer.hpp"
#include "embree_core/prepared_object.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/gallery.hpp"
#include "support/long_tests.hpp"

namespace test_lines_for_meshes {

using namespace phasetree;

namespace {

// How many of some points have none of the others within a distance.
std::size_t without_counterpart(const std::vector<glm::vec3>& points, std::vector<glm::vec3> others, float distance) {
    const auto x = [](const glm::vec3& p) { return p.x; };
    std::ranges::sort(others, {}, x);
    return static_cast<std::size_t>(std::ranges::count_if(points, [&](const glm::vec3& p) {
        const auto first = std::ranges::lower_bound(others, p.x - distance, {}, x);
        const auto last = std::ranges::upper_bound(others, p.x + distance, {}, x);
        return std::none_of(first, last, [&](const glm::vec3& q) { return glm::distance(p, q) <= distance; });
    }));
}

// The triangles between each pair of phases.
std::map<std::pair<int, int>, int> interfaces_of(const PhaseMesh& mesh) {
    std::map<std::pair<int, int>, int> count;
    for (const PhaseMesh::Triangle& t : mesh.triangles) ++count[{t.behind.index, t.front.index}];
    return count;
}

}  // namespace

TEST_CASE("a mesh by cells is the one by the whole program") {
    const float spacings = tests::long_tests() ? 60 : 18;
    std::size_t vertices = 0, differ = 0;
    int triangles = 0, others = 0;
    for (const char* name : {"cable", "inlaid_spheres", "rock_wall", "two_pears"}) {
        CAPTURE(name);
        const Document document = Document::from_file(source_directory() + "/scenes/" + name + ".json");
        const Phased object = read_tree(document).object;
        const embree::PreparedObject prepared(object, {.quality = BuildQuality::low});
        const InterfaceTracer tracer(object);
        const Bounds bounds = tracer.bounds();
        const MeshOptions options{.spacing = bounds.diagonal() / spacings};
        const PhaseMesh fast = mesh_of(bounds, embree::line_tracer(prepared.scene()), options);
        const PhaseMesh slow = mesh_of(bounds, line_tracer(tracer), options);
        CHECK(fast.crossings == slow.crossings);
        CHECK(fast.skipped == slow.skipped);
        vertices += fast.vertices.size();
        const float near = 0.02f * options.spacing;
        differ += without_counterpart(fast.vertices, slow.vertices, near) +
                  without_counterpart(slow.vertices, fast.vertices, near);
        const auto of_fast = interfaces_of(fast), of_slow = interfaces_of(slow);
        REQUIRE(of_fast.size() == of_slow.size());
        for (const auto& [phases, count] : of_fast) {
            REQUIRE(of_slow.contains(phases));
            triangles += count;
            others += std::abs(count - of_slow.at(phases));
        }
    }
    // Where three planes nearly agree, a normal's last digits decide about a vertex, and where triangles are about as
    // close to each other as rounding errors, they decide whether vertices are added to separate them.
    CHECK(differ * 200 < vertices);
    CHECK(others * 200 < triangles);
    CHECK(vertices > (tests::long_tests() ? 20'000u : 1'500u));
}

}  // namespace test_lines_for_meshes
