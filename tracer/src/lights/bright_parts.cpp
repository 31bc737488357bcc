#include "lights/bright_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "lights/lat_long.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t most_parts = 4;
// Minimum ratio of a part's luminance to the mean of the environment. For the sun it is in the thousands, for a window
// about ten.
constexpr double least_contrast = 16;
// Cells belong to a part if they have at least this share of its greatest luminance.
constexpr double edge = 1.0 / 8;
// Wider caps would spread photons thinly, and large lights cause only soft caustics.
constexpr double widest = 25 * std::numbers::pi / 180;

// The cells of the distribution, numbered row by row from the zenith down.
struct Cells {
    const LatLongDistribution& distribution;
    std::size_t width = static_cast<std::size_t>(distribution.width()),
                height = static_cast<std::size_t>(distribution.height());

    std::size_t size() const { return width * height; }
    // The ratio of a cell's luminance to the mean of the environment.
    double contrast(std::size_t cell) const {
        if (!(distribution.integral() > 0.0f)) return 0;
        return 4 * std::numbers::pi * static_cast<double>(distribution.cell_pdf(cell % width, cell / width));
    }
    glm::dvec3 middle(std::size_t cell) const {
        const double u = (static_cast<double>(cell % width) + 0.5) / static_cast<double>(width),
                     v = (static_cast<double>(cell / width) + 0.5) / static_cast<double>(height);
        return direction_of((2 * u - 1) * std::numbers::pi, std::cos(v * std::numbers::pi));
    }
    double solid_angle(std::size_t cell) const {
        const double step = std::numbers::pi / static_cast<double>(height),
                     above = static_cast<double>(cell / width) * step;
        return 2 * std::numbers::pi / static_cast<double>(width) * (std::cos(above) - std::cos(above + step));
    }
    // From the centre of a cell to slightly beyond its corners. Interpolation spreads light into the neighbouring
    // cells; if that is much, they belong to a part themselves.
    double reach() const {
        return 0.75 * std::numbers::pi *
               portable::hypot(1 / static_cast<double>(height), 2 / static_cast<double>(width));
    }
};

// The first cell, and all cells connected to it through neighbours of at least this contrast. Columns wrap around.
std::vector<std::size_t> connected(const Cells& cells, std::size_t first, double least) {
    std::vector<std::size_t> found{first};
    std::vector<bool> is_in(cells.size());
    is_in[first] = true;
    for (std::size_t next = 0; next < found.size(); ++next) {
        const std::size_t row = found[next] / cells.width, column = found[next] % cells.width;
        const auto consider = [&](std::size_t x, std::size_t y) {
            const std::size_t cell = y * cells.width + x;
            if (is_in[cell] || cells.contrast(cell) < least) return;
            is_in[cell] = true;
            found.push_back(cell);
        };
        consider((column + 1) % cells.width, row);
        consider((column + cells.width - 1) % cells.width, row);
        if (row > 0) consider(column, row - 1);
        if (row + 1 < cells.height) consider(column, row + 1);
    }
    return found;
}

Cap cap_around(const Cells& cells, const std::vector<std::size_t>& part) {
    glm::dvec3 sum(0);
    for (const std::size_t cell : part) sum += cells.solid_angle(cell) * cells.contrast(cell) * cells.middle(cell);
    const double length = glm::length(sum);
    const glm::dvec3 axis = length > 0 ? sum / length : cells.middle(part.front());
    double half_chord = 0;
    for (const std::size_t cell : part) half_chord = std::max(half_chord, 0.5 * glm::length(cells.middle(cell) - axis));
    const double angle = std::min(2 * portable::asin(std::min(half_chord, 1.0)) + cells.reach(), widest);
    return {glm::normalize(glm::vec3(axis)), angle};
}

}  // namespace

std::vector<Cap> bright_parts(const LatLongDistribution& distribution) {
    const Cells cells{distribution};
    // Candidates to start a part, the brightest first; equal ones in the order of the cells.
    std::vector<std::size_t> bright;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
        if (cells.contrast(cell) >= least_contrast) bright.push_back(cell);
    std::ranges::stable_sort(bright, std::greater(), [&](std::size_t cell) { return cells.contrast(cell); });
    std::vector<Cap> parts;
    for (const std::size_t cell : bright) {
        const glm::vec3 middle(cells.middle(cell));
        if (std::ranges::any_of(parts, [&](const Cap& part) { return part.contains(middle); })) continue;
        parts.push_back(cap_around(cells, connected(cells, cell, edge * cells.contrast(cell))));
        if (parts.size() == most_parts) break;
    }
    return parts;
}

}  // namespace phasetree::tracer
