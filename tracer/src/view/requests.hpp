// The page's requests and the answers, as JSON.
#pragma once

#include <stdexcept>
#include <string>

#include "view/probe.hpp"
#include "view/selection_mask.hpp"
#include "view/session.hpp"

namespace phasetree::tracer::view {

/// {"camera": {…} | null, "hidden": ["glass", …], "looks": {"glass": {"clear": true, "color": "#ffee80", "ior": 1.4,
/// "roughness": 0.1}}, "cut": {"normal": [1, 0, 0], "offset": 0.1} | null, "numbers": {"/tree/set/of/sphere/radius":
/// 1.5}, "hidden_parts": ["/tree/over/1"], "time": 0.5, "layer": "depth", "exposure": 0.5}, where all members are
/// optional. The camera is written as in a scene file. Throws SceneError.
Change read_change(const std::string& text, const Shown& shown);

/// {"x": 12.5, "y": 7}, in pixels of the whole picture. Throws SceneError.
glm::vec2 read_place(const std::string& text, const Shown& shown);

/// {"pointers": ["/tree/over/1"], "phases": ["glass"]}. Throws SceneError.
SelectedParts read_selected(const std::string& text);

/// The answer as one line. The pixels of a mask are written row by row as lengths of runs, alternating between pixels
/// that are not selected and pixels that are, beginning with the former.
std::string written(const Shown& shown);
std::string written(const Probed& probed);
std::string written(const SelectionMask& mask);
std::string written(const TextNumbers& numbers, std::uint64_t version);

}  // namespace phasetree::tracer::view
