// Meshes whose lines go through cells in Embree are those of the whole program's lines.
#include <doctest/doctest.h>

#include "embree_core/line_tracer.hpp"
#include "embree_core/prepared_object.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/gallery.hpp"
#include "support/long_tests.hpp"

namespace test_lines_for_meshes {

using namespace phasetree;

TEST_CASE("a mesh by cells is the one by the whole program") {
    const float spacings = tests::long_tests() ? 60 : 24;
    std::size_t vertices = 0, differ = 0, labels = 0;
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
        REQUIRE(fast.vertices.size() == slow.vertices.size());
        REQUIRE(fast.triangles.size() == slow.triangles.size());
        vertices += fast.vertices.size();
        for (std::size_t i = 0; i < fast.vertices.size(); ++i)
            differ += glm::distance(fast.vertices[i], slow.vertices[i]) > 0.02f * options.spacing ? 1 : 0;
        for (std::size_t i = 0; i < fast.triangles.size(); ++i)
            labels += fast.triangles[i].behind != slow.triangles[i].behind ||
                              fast.triangles[i].front != slow.triangles[i].front
                          ? 1
                          : 0;
    }
    CHECK(labels == 0);
    // Where three planes nearly agree, a normal's last digits decide.
    CHECK(differ * 1000 < vertices);
    CHECK(vertices > (tests::long_tests() ? 20'000u : 3'000u));
}

}  // namespace test_lines_for_meshes
