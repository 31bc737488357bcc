// A rectangle of pixels of the whole picture, whose top left pixel is (0, 0).
#pragma once

#include <cstddef>

namespace phasetree::tracer {

/// Pixels [x0, x1) × [y0, y1).
struct PixelRange {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    std::size_t size() const { return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()); }
    /// The index of a pixel of the rectangle, row by row from the top left.
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x - x0);
    }
};

}  // namespace phasetree::tracer
