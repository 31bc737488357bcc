// Pictures of slices.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "command/quantity.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/measuring/slice.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::tracer {

// What all slices of a stack share.
struct SliceFrame {
    const PhaseNames& names;
    PhaseSet phases;                         // of the object; the page of each slice has room for all of them
    std::vector<std::array<int, 3>> colors;  // of all phases, as sRGB codes; white for the vacuum
    LengthUnit lengths;
    glm::vec2 low, high;  // the rectangle that is shown: the object's bounds
    std::string plane;    // the title, such as "z = 0.3"
};

// An SVG picture: each phase is a path, whose coordinates are those of the scene, with a legend and a scale bar.
std::string slice_svg(const Slice&, const SliceFrame&);

// A PNG picture with a palette: the pixels are the indices of the phases at their centres, `size` along the longer
// side. Throws SlicingCancelled. `cancelled` and `progress`, which receives a fraction, are called from any thread.
std::string slice_png(const Program&, const SlicePlane&, const SliceFrame&, int size,
                      const std::function<bool()>& cancelled, const std::function<void(double)>& progress);

}  // namespace phasetree::tracer
