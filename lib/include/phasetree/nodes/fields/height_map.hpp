#pragma once

#include <algorithm>
#include <cstdint>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/height_grid.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The terrain z < h(x, y) of an image. h is the biquadratic B-spline of the pixels: smooth, within their range, and
/// with slopes that are averages of the differences between neighbours. With the largest of these differences along x
/// and y, Lx and Ly, f = (z − h)/√(1 + Lx² + Ly²) is 1-Lipschitz. So is
///     min(max(f, z − high), z − low),
/// which has slope 1 away from the surface. It has the sign of f everywhere, because the heights are between low and
/// high. Beyond its edges the image continues with the values at its border.
struct HeightMap {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "height_map", "7.1",
        "min(max((z − h(x, y))/√(1 + Lx² + Ly²), z − max h), z − min h),  h the quadratic "
        "B-spline of the pixels",
        "The ground below a height map, which is centred on the z axis; black is low and white is high."};
    FromFile<HeightGrid> file{};
    float size_x = 10;
    float size_y = 10;
    float height = 1;
    std::vector<float> table{};  ///< derived: columns, rows, 1/pixel along x and y, 1/λ, low, high, the heights
    float highest = 1;           ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&HeightMap::file, Parameter{"file", "", "Image file, of which the first channel is used."});
        v(&HeightMap::size_x, Parameter{"size_x", "m", "Width of the image, along x.", limits::positive});
        v(&HeightMap::size_y, Parameter{"size_y", "m", "Height of the image, along y.", limits::positive});
        v(&HeightMap::height, Parameter{"height", "m", "Height of white; black is at z = 0.", limits::positive});
    }
    void prepare() {
        const HeightGrid& grid = *file.content;
        detail::require_usable(info.name, {size_x, size_y, height});
        if (grid.width < 2 || grid.height < 2)
            throw ModelError("height_map: the image must have at least 2 × 2 pixels");
        if (grid.width > 4096 || grid.height > 4096)
            throw ModelError("height_map: the image is larger than 4096 × 4096 pixels");
        const auto columns = static_cast<std::size_t>(grid.width), rows = static_cast<std::size_t>(grid.height);
        if (grid.values.size() != columns * rows)
            throw ModelError("height_map: the image is incomplete: some pixels are missing");
        const float step_x = static_cast<float>(grid.width) / size_x, step_y = static_cast<float>(grid.height) / size_y;
        table.assign(7, 0.f);
        float low = Bounds::infinity, high = -Bounds::infinity;
        double slope_x = 0, slope_y = 0;
        // The first row is at the largest y; in the table, y increases.
        const auto at = [&](std::size_t x, std::size_t y) {
            return height * grid.values[(rows - 1 - y) * columns + x];
        };
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < columns; ++x) {
                const float h = at(x, y);
                if (!(std::abs(h) < 1e9f))
                    throw ModelError("height_map: the image has a pixel that is not a finite number");
                low = std::min(low, h);
                high = std::max(high, h);
                if (x > 0)
                    slope_x = std::max(slope_x,
                                       std::abs(static_cast<double>(h - at(x - 1, y)) * static_cast<double>(step_x)));
                if (y > 0)
                    slope_y = std::max(slope_y,
                                       std::abs(static_cast<double>(h - at(x, y - 1)) * static_cast<double>(step_y)));
                table.push_back(h);
            }
        const double lipschitz = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y) * (1 + 1e-5);
        table[0] = static_cast<float>(grid.width);
        table[1] = static_cast<float>(grid.height);
        table[2] = step_x;
        table[3] = step_y;
        table[4] = static_cast<float>(1 / lipschitz);
        table[5] = low;
        table[6] = high;
        highest = high;
    }
    static constexpr std::uint16_t floats_read = 9;  ///< the number of floats of data() that one evaluation reads
    static constexpr unsigned half_instructions = 120;
    static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        const float columns = data[0], rows = data[1];
        const float* heights = data + 7;
        const Axis<T> x(p.x * data[2] + 0.5f * columns, columns), y(p.y * data[3] + 0.5f * rows, rows);
        T h(0.f);
        for (int j = 0; j < 3; ++j) {
            T row(0.f);
            for (int i = 0; i < 3; ++i) row = row + lookup(heights, y.index[j] * columns + x.index[i]) * x.weight[i];
            h = h + row * y.weight[j];
        }
        return min(max((p.z - h) * data[4], p.z - data[6]), p.z - data[5]);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        Bounds b = Bounds::everything();
        b.high.z = highest + level;
        return b;
    }

  private:
    /// The three pixels around a coordinate given in pixels, and their weights.
    template <class T>
    struct Axis {
        T index[3], weight[3];

        Axis(const T& coordinate, float size) {
            const T u = clamp(coordinate, T(0.f), T(size));
            const T middle = clamp(floor(u), T(0.f), T(size - 1));
            const T t = u - middle, s = 1.f - t;
            index[0] = max(middle - 1.f, T(0.f));
            index[1] = middle;
            index[2] = min(middle + 1.f, T(size - 1));
            weight[0] = s * s * 0.5f;
            weight[2] = t * t * 0.5f;
            weight[1] = 1.f - weight[0] - weight[2];
        }
    };
};

}  // namespace phasetree
