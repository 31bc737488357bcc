// What the page asks for and is told, as JSON.
#pragma once

#include <stdexcept>
#include <string>

#include "view/probe.hpp"
#include "view/session.hpp"

namespace phasetree::tracer::view {

/// {"camera": {…} | null, "hidden": ["glass", …], "looks": {"glass": {"clear": true, "color": "#ffee80", "ior": 1.4,
/// "roughness": 0.1}}, "cut": {"normal": [1, 0, 0], "offset": 0.1} | null, "exposure": 0.5}, each of which may be left
/// out. The camera is as a scene's file says it. Throws SceneError.
Change read_change(const std::string& text, const Shown& shown);

/// {"x": 12.5, "y": 7}, in pixels of the whole picture. Throws SceneError.
glm::vec2 read_place(const std::string& text, const Shown& shown);

/// One line.
std::string written(const Shown& shown);
std::string written(const Probed& probed);
std::string written(const TextNumbers& numbers, std::uint64_t version);

}  // namespace phasetree::tracer::view
