// The page's requests and the answers, as JSON.
#pragma once

#include <stdexcept>
#include <string>

#include "view/probe.hpp"
#include "view/session.hpp"

namespace phasetree::tracer::view {

/// {"camera": {…} | null, "hidden": ["glass", …], "looks": {"glass": {"clear": true, "color": "#ffee80", "ior": 1.4,
/// "roughness": 0.1}}, "cut": {"normal": [1, 0, 0], "offset": 0.1} | null, "numbers": {"/tree/set/of/sphere/radius":
/// 1.5}, "time": 0.5, "layer": "depth", "exposure": 0.5}, where all members are optional. The camera is written as in a
/// scene file. Throws SceneError.
Change read_change(const std::string& text, const Shown& shown);

/// {"x": 12.5, "y": 7}, in pixels of the whole picture. Throws SceneError.
glm::vec2 read_place(const std::string& text, const Shown& shown);

/// The answer as one line.
std::string written(const Shown& shown);
std::string written(const Probed& probed);
std::string written(const TextNumbers& numbers, std::uint64_t version);

}  // namespace phasetree::tracer::view
