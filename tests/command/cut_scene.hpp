// A scene with something for every plane, for renders that are cut into pieces in any way.
#pragma once

#include "command.hpp"
#include "support/long_tests.hpp"
#include "support/uniform.hpp"

namespace phasetree::tests {

// Water in glass on a floor, lamps of two groups, caustics. The film has two bands of rows, the second of which is cut
// off, and tiles that are cut off.
inline std::string cut_scene(int samples) {
    SceneText scene;
    scene.tree = R"({"thin_shell": {"of": "ball", "shell": "glass", "inside": "water", "half_thickness": 0.1}})";
    scene.lights = R"([{"constant": {"intensity": 0.4, "group": "sky"}},
        {"sphere": {"centre": [2, -2, 3], "radius": 0.5, "intensity": 20, "group": "lamp"}}],
"meshes": [{"floor": {"height": -1.2, "material": {"diffuse": {"color": "#808080"}}}}])";
    scene.rest =
        R"("render": {"width": 28, "height": 21, "caustics": true, "samples": )" + std::to_string(samples) + "}";
    return scene.text();
}

// Words of a command line, one after the other.
inline std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// A whole number from 0 on, below n.
inline int below(Uniform& random, int n) {
    return std::min(static_cast<int>(static_cast<float>(n) * random()), n - 1);
}

}  // namespace phasetree::tests
