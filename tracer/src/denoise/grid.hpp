// Values at the pixels of a picture and of a margin around it, into which the picture is mirrored. So code that
// accesses the neighbourhood of a pixel need not check the picture's bounds.
#pragma once

#include <cstddef>
#include <vector>

namespace phasetree::tracer {

/// The radius of the neighbourhood of a pixel used by denoising: that of the widest window plus that of a patch.
inline constexpr int grid_margin = 7;

template <class T>
class Grid {
  public:
    Grid(int width, int height)
        : width_(width),
          height_(height),
          stride_(width + 2 * grid_margin),
          values_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2 * grid_margin)) {}

    int width() const { return width_; }
    int height() const { return height_; }
    bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    /// From −grid_margin to width or height + grid_margin, exclusive.
    T& at(int x, int y) { return values_[index(x, y)]; }
    const T& at(int x, int y) const { return values_[index(x, y)]; }

    /// Mirrors the picture into the margin, repeatedly if the picture is smaller than the margin.
    void fill_margin() {
        for (int y = -grid_margin; y < height_ + grid_margin; ++y)
            for (int x = -grid_margin; x < width_ + grid_margin; ++x)
                if (!has(x, y)) at(x, y) = at(mirrored(x, width_), mirrored(y, height_));
    }

  private:
    static int mirrored(int i, int size) {
        const int period = 2 * size, within = (i % period + period) % period;
        return within < size ? within : period - 1 - within;
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y + grid_margin) * static_cast<std::size_t>(stride_) +
               static_cast<std::size_t>(x + grid_margin);
    }

    int width_, height_, stride_;
    std::vector<T> values_;
};

}  // namespace phasetree::tracer
