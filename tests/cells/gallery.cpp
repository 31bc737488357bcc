// The objects of the gallery have nodes of all kinds at their real sizes: rays must find every interface of the whole
// object in their cells, and no other.
#include <doctest/doctest.h>

#include <filesystem>

#include "phasetree/cells/cells.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "support/compared_crossings.hpp"
#include "support/gallery.hpp"

namespace test_gallery {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("the nearest crossing over all cells is the whole object's in the gallery's scenes") {
    Compared all;
    int scenes = 0;
    for (const std::filesystem::path& path : gallery_of_the_library()) {
        CAPTURE(path.string());
        Random rng(15);  // files come in any order
        const std::size_t before = all.different;
        // Building the cells takes nearly all of the time. The short form builds them as in a render for three scenes,
        // and with low quality for the others. cells/rays tests cells of medium quality of random trees.
        const std::string name = path.stem().string();
        const bool is_medium = long_tests() || name == "hourglass" || name == "cable" || name == "two_pears";
        compare_crossings(read_tree(Document::from_file(path)).object, {}, long_tests() ? 2000 : 40, rng, all,
                          is_medium ? BuildQuality::medium : BuildQuality::low);
        CHECK(all.different == before);
        ++scenes;
    }
    MESSAGE(scenes, " scenes, ", all.rays, " rays, ", all.crossings, " crossings");
    CHECK(scenes > 20);
    CHECK(all.crossings > all.rays);
}

// The division of a box that is larger than the bumps of its noise saves nothing at first. When such boxes were not
// divided further, those of more than two bumps had 29 % of the surface of all cells of the scoops, and so as many of
// the visits of rays; now they have 17 %.
TEST_CASE("boxes larger than the bumps of their noise are divided further") {
    const InterfaceCells cells(read_tree(Document::from_file(source_directory() + "/scenes/ice_cup.json")).object);
    double all = 0, large = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Bounds box = cells.bounds(i);
        const glm::dvec3 e(box.extent());
        const double surface = e.x * e.y + e.y * e.z + e.z * e.x;
        all += surface;
        if (box.diagonal() > 0.24f) large += surface;
    }
    MESSAGE("boxes of more than two bumps have ", 100 * large / all, " % of the cells' surface");
    CHECK(large < 0.23 * all);
}

}  // namespace test_gallery
