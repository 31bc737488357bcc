// Long work on a scene is cancelled when a newer scene is wanted, even while the object's program is being recorded.
#include <doctest/doctest.h>

#include "phasetree/io/document.hpp"
#include "phasetree/model/preparation_watch.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/scene.hpp"

namespace test_cancelling {

using namespace phasetree;

TEST_CASE("recording a program can be cancelled") {
    // 40,000 balls.
    const tracer::Scene scene = tracer::read_scene(Document::from_text(
        R"({"version": 1, "phases": {"wood": {"diffuse": {"color": [0.5, 0.3, 0.1]}}},
            "tree": {"set": {"phase": "wood", "of": {"fibonacci_sphere": {"count": 200, "radius": 9, "of":
                {"fibonacci_sphere": {"count": 200, "radius": 1, "of": {"sphere": {"radius": 0.01}}}}}}}},
            "lights": [{"constant": {"radiance": [1, 1, 1]}}], "camera": {"position": [0, -30, 0], "look_at": [0, 0, 0]}})"));
    int polls = 0;
    const PreparationWatch watch({.cancelled = [&] { return ++polls > 1; }, .progress = {}});
    CHECK_THROWS_AS(InterfaceTracer(scene.object), PreparationCancelled);
    CHECK(polls == 2);
}

}  // namespace test_cancelling
