// The scenes of `phasetree new`.
#include "studio/starts.hpp"

#include <doctest/doctest.h>

#include "phasetree/io/document.hpp"
#include "scene/scene.hpp"
#include "studio/outline.hpp"

namespace test_starts {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::studio;

TEST_CASE("the scenes to start from are valid, and have what a person needs to go on") {
    std::vector<std::string_view> names;
    const Vocabulary vocabulary;
    for (const StartFile& start : start_files()) {
        CAPTURE(start.name);
        names.push_back(start.stem());
        CHECK(start.summary().size() > 10);
        const Document document = Document::from_text(std::string(start.text), std::string(start.name));
        const Scene scene = read_scene(document);
        CHECK_FALSE(scene.lights.empty());
        CHECK(phasetree::bounds(scene.object).finite());
        CHECK(scene.meshes.size() == 1);
        // The tree is a list to which objects are added.
        const Outline outline = outline_of(document, vocabulary);
        bool has_list = false;
        for (const OutlineEntry& entry : outline.entries) has_list = has_list || entry.kind == "over";
        CHECK((has_list || document.text().find("\"over\": [") != std::string::npos));
    }
    CHECK(names == std::vector<std::string_view>{"bottle", "candle", "empty", "glass", "jar", "ring"});
}

}  // namespace test_starts
