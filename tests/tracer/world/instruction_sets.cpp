// Pictures have the same bits whichever instruction set Embree uses: its order of visits and the last bits of its hits
// on triangles depend on it.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/render.hpp"
#include "source_directory.hpp"
#include "support/long_tests.hpp"
#include "tracer/support/paths.hpp"

namespace test_instruction_sets {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

std::vector<glm::vec3> picture(const Scene& scene, const std::string& embree_configuration) {
    const World world(scene, {.quality = phasetree::BuildQuality::low, .embree_configuration = embree_configuration});
    return render(world, scene, {.pixels = scene.film.whole()}).image.pixels;
}

int count_differences(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    REQUIRE(a.size() == b.size());
    int differences = 0;
    for (std::size_t i = 0; i < a.size(); ++i) differences += a[i] != b[i];
    return differences;
}

Scene small(phasetree::Document document) {
    Scene scene = read_scene(std::move(document));
    scene.settings.samples = phasetree::tests::long_tests() ? 16 : 4;
    scene.film.width = 96;
    scene.film.height = 72;
    return scene;
}

void check_instruction_sets(const Scene& scene) {
    int compared = 0;
    const std::vector<glm::vec3> expected = picture(scene, "");
    // The default is the best instruction set of this processor. The short form compares it with the oldest one and
    // with AVX2, which most processors have.
    std::vector<std::string> sets{"sse2", "avx2"};
    if (phasetree::tests::long_tests()) sets.insert(sets.end(), {"sse4.2", "avx", "avx512"});
    for (const std::string& name : sets) {
        CAPTURE(name);
        try {
            CHECK(count_differences(picture(scene, "isa=" + name), expected) == 0);
            ++compared;
        } catch (const std::runtime_error&) {
            // This processor, or this build of Embree, does not have it.
        }
    }
#if defined(__x86_64__)
    CHECK(compared >= (phasetree::tests::long_tests() ? 2 : 1));
#endif
    MESSAGE(compared, " instruction sets");
}

}  // namespace

TEST_CASE("a scene of the gallery has the same picture for all instruction sets") {
    std::vector<std::string> names{"two_pears", "cable", "wet_sand", "enamel_mug"};
    if (phasetree::tests::long_tests()) {
        names.clear();
        for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/scenes"))
            if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
                names.push_back(entry.path().stem());
        std::ranges::sort(names);
    }
    for (const std::string& name : names) {
        CAPTURE(name);
        check_instruction_sets(small(phasetree::Document::from_file(source_directory() + "/scenes/" + name + ".json")));
    }
}

}  // namespace test_instruction_sets
