#pragma once

#include <array>

#include "phasetree/math/bounds.hpp"

namespace phasetree::building {

/// The boxes into which a box is divided: it is halved along its longest axis, and along each other axis that is not
/// much shorter.
struct SubBoxes {
    static constexpr std::size_t most = 8;
    std::array<Bounds, most> box;
    std::size_t count = 1;

    explicit SubBoxes(const Bounds& whole);
};

}  // namespace phasetree::building
