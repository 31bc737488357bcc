// Finds the pixels of a picture that show the selection.
#pragma once

#include <chrono>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "view/shown.hpp"

namespace phasetree::tracer::view {

/// What is selected: nodes and meshes of the scene's file, by their JSON pointers, and whole phases.
struct SelectedParts {
    std::vector<std::string> pointers, phases;
};

struct SelectionMask {
    std::uint64_t picture = 0;  ///< Picture::number
    glm::ivec2 size{0};
    std::vector<bool> is_selected;  ///< row by row
};

/// A pixel is selected if a straight ray through it reaches a surface of a selected part before anything opaque. The
/// surface of a node is where one of the primitives below the node decides the label. Clear surfaces do not hide what
/// is behind them, and refraction is ignored, as for the handles.
///
/// The mask's longer side has at most `most_pixels_of_mask` pixels. Parts smaller than 8×8 of them may be missed.
/// Throws ModelError if it takes longer than `longest`.
SelectionMask selection_mask(const Picture& picture, const SelectedParts& parts,
                             std::chrono::milliseconds longest = std::chrono::seconds(3));

constexpr int most_pixels_of_mask = 480;

}  // namespace phasetree::tracer::view
