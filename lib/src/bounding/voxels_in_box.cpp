#include "bounding/voxels_in_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/dual.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/labels.hpp"

namespace phasetree::bounding {

using voxels::Table;

namespace {

// In a box with more relevant voxels, their blocks give the bounds.
constexpr int max_voxels = 512;

// The voxels that are relevant in a box, as the first and the last along each axis.
struct Counted {
    std::array<int, 3> first, last;
    std::array<bool, 3> is_beyond;  // whether the box extends beyond where the field varies along the axis

    Counted(const float* data, const PointRange& box, bool is_spline) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto spacing = 1 / static_cast<double>(data[voxels::inverse_spacing + i]);
            const double centre = (box.centre[i] - static_cast<double>(data[voxels::first + i])) / spacing;
            // Coordinates in voxels are rounded to floats.
            const double half_extent = box.half_extents[i] / spacing + 1e-6 * (std::abs(centre) + 64);
            const auto size = static_cast<double>(data[voxels::size + i]);
            const double beyond = is_spline ? 0.5 : 0;
            is_beyond[i] = centre - half_extent < -beyond || centre + half_extent > size - 1 + beyond;
            const double low = std::clamp(centre - half_extent, 0.0, size - 1),
                         high = std::clamp(centre + half_extent, 0.0, size - 1);
            const double lowest = is_spline ? std::floor(low + 0.5) - 1 : std::floor(low);
            const double highest = std::floor(is_spline ? high + 0.5 : high) + 1;
            // A spline also uses the copies next to the border voxels, where the differences are zero.
            const double copies = is_spline ? 1 : 0;
            first[i] = static_cast<int>(std::max(lowest, -copies));
            last[i] = static_cast<int>(std::min(highest, size - 1 + copies));
            // At the border, the last cell of two voxels is extrapolated.
            if (!is_spline) first[i] = std::max(std::min(first[i], static_cast<int>(size) - 2), 0);
        }
    }
    int along(std::size_t axis) const { return last[axis] - first[axis] + 1; }
    double all() const { return static_cast<double>(along(0)) * along(1) * along(2); }
};

Interval range_of_blocks(const Table& table, const Counted& counted) {
    Interval values{Interval::most, -Interval::most};
    const auto first = [&](std::size_t axis) { return std::max(counted.first[axis], 0) & ~7; };
    const auto last = [&](std::size_t axis) { return std::min(counted.last[axis], table.size[axis] - 1); };
    for (int z = first(2); z <= last(2); z += 8)
        for (int y = first(1); y <= last(1); y += 8)
            for (int x = first(0); x <= last(0); x += 8) {
                const float* block = table.block_of(x, y, z);
                values.low = std::min(values.low, static_cast<double>(block[1]));
                values.high = std::max(values.high, static_cast<double>(block[2]));
            }
    return values;
}

// The values of the relevant voxels, and the ranges of their differences.
class Differences {
  public:
    Differences(const Table& table, const Counted& counted) : counted_(counted) {
        const auto there = [&](int n, std::size_t axis) { return std::clamp(n, 0, table.size[axis] - 1); };
        std::size_t i = 0;
        for (int z = counted.first[2]; z <= counted.last[2]; ++z)
            for (int y = counted.first[1]; y <= counted.last[1]; ++y)
                for (int x = counted.first[0]; x <= counted.last[0]; ++x)
                    values_[i++] = table(there(x, 0), there(y, 1), there(z, 2));
        stride_ = {1, counted.along(0), counted.along(0) * counted.along(1)};
    }
    Interval values() const {
        return over({1, 1, 1}, [](const float* v) { return static_cast<double>(*v); });
    }
    // Between neighbours along an axis.
    Interval first(std::size_t axis) const {
        std::array<int, 3> needs{1, 1, 1};
        ++needs[axis];
        const int s = stride_[axis];
        return over(needs, [&](const float* v) { return static_cast<double>(v[s]) - static_cast<double>(v[0]); });
    }
    Interval second(std::size_t axis) const {
        std::array<int, 3> needs{1, 1, 1};
        needs[axis] += 2;
        const int s = stride_[axis];
        return over(needs, [&](const float* v) {
            return static_cast<double>(v[2 * s]) - 2 * static_cast<double>(v[s]) + static_cast<double>(v[0]);
        });
    }
    Interval mixed(std::size_t a, std::size_t b) const {
        std::array<int, 3> needs{1, 1, 1};
        ++needs[a];
        ++needs[b];
        const int s = stride_[a], t = stride_[b];
        return over(needs, [&](const float* v) {
            return static_cast<double>(v[s + t]) - static_cast<double>(v[s]) - static_cast<double>(v[t]) +
                   static_cast<double>(v[0]);
        });
    }

  private:
    // The range of f over all voxels that have the required number of relevant voxels after them; [0, 0] if there are
    // none.
    template <class F>
    Interval over(const std::array<int, 3>& needs, const F& f) const {
        Interval range{Interval::most, -Interval::most};
        for (int z = 0; z + needs[2] <= counted_.along(2); ++z)
            for (int y = 0; y + needs[1] <= counted_.along(1); ++y)
                for (int x = 0; x + needs[0] <= counted_.along(0); ++x) {
                    const double d = f(values_.data() + x + y * stride_[1] + z * stride_[2]);
                    range.low = std::min(range.low, d);
                    range.high = std::max(range.high, d);
                }
        return range.low <= range.high ? range : Interval{};
    }

    const Counted& counted_;
    std::array<float, max_voxels> values_;
    std::array<int, 3> stride_{};
};

// The range of the eigenvalues of a symmetric matrix whose entries are in these ranges (Gershgorin's circles).
Interval eigenvalues(const std::array<Interval, 3>& diagonal, const std::array<Interval, 3>& others) {
    // others[i] is the entry that is in neither row i nor column i.
    Interval all{Interval::most, -Interval::most};
    for (std::size_t i = 0; i < 3; ++i) {
        double radius = 0;
        for (std::size_t j = 0; j < 3; ++j)
            if (j != i) radius += others[j].magnitude();
        all = {std::min(all.low, diagonal[i].low - radius), std::max(all.high, diagonal[i].high + radius)};
    }
    return all;
}

}  // namespace

VoxelsInBox voxels_in_box(const float* data, const PointRange& box, bool is_spline) {
    const Table table(data);
    const Counted counted(data, box, is_spline);
    VoxelsInBox known{range_of_blocks(table, counted)};
    if (counted.all() > max_voxels) return known;
    const Differences differences(table, counted);
    FieldInBox field;
    field.values = differences.values();
    // Round the values of the field as its equation does.
    const double rounding_error = 4e-7 * field.values.magnitude();
    field.values = {field.values.low - rounding_error, field.values.high + rounding_error};
    std::array<double, 3> inverse;
    for (std::size_t i = 0; i < 3; ++i) {
        inverse[i] = static_cast<double>(data[voxels::inverse_spacing + i]);
        field.gradients[i] = differences.first(i) * inverse[i];
        if (counted.is_beyond[i]) field.gradients[i] = hull(field.gradients[i], {});
    }
    const auto coordinate = [&](std::size_t i) {
        return Dual(static_cast<float>(box.centre[i]), i == 0 ? 1.f : 0.f, i == 1 ? 1.f : 0.f, i == 2 ? 1.f : 0.f);
    };
    const Vec3<Dual> centre{coordinate(0), coordinate(1), coordinate(2)};
    const Dual at_centre = is_spline ? voxels::spline_at(data, centre) : voxels::linear_at(data, centre);
    field.value = static_cast<double>(at_centre.value());
    for (std::size_t i = 0; i < 3; ++i) {
        field.gradient[i] = static_cast<double>(at_centre.gradient()[static_cast<int>(i)]);
        field.gradients[i] = hull(field.gradients[i], {field.gradient[i], field.gradient[i]});
    }
    const bool is_within = std::ranges::none_of(counted.is_beyond, [](bool b) { return b; });
    const bool is_one_cell = counted.along(0) <= 2 && counted.along(1) <= 2 && counted.along(2) <= 2;
    field.curvature = Interval::all();
    if (is_within && (is_spline || is_one_cell)) {
        std::array<Interval, 3> diagonal{}, others{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            if (is_spline) diagonal[i] = differences.second(i) * (inverse[i] * inverse[i]);
            others[i] = differences.mixed(j, k) * (inverse[j] * inverse[k]);
        }
        field.curvature = eigenvalues(diagonal, others);
    }
    known.field = field;
    return known;
}

}  // namespace phasetree::bounding

namespace phasetree {

namespace {

enclosure::Enclosure enclosed_by_voxels(const float* data, const Vec3<enclosure::Enclosure>& q,
                                        const std::array<double, 3>& half, bool is_spline) {
    const enclosure::Region at(q);
    const bounding::VoxelsInBox known = bounding::voxels_in_box(data, at, is_spline);
    if (known.field) return enclose(*known.field, at).tightened(half);
    const Vec3<float> centre = at.point();
    const float value = is_spline ? voxels::spline_at(data, centre) : voxels::linear_at(data, centre);
    return enclose_lipschitz(static_cast<double>(value), known.values, q, half);
}

}  // namespace

std::optional<enclosure::Enclosure> Volume::Samples::enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                              const std::array<double, 3>& half) {
    return enclosed_by_voxels(data, q, half, false);
}
std::optional<enclosure::Enclosure> Labels::Depth::enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                            const std::array<double, 3>& half) {
    return enclosed_by_voxels(data, q, half, true);
}

}  // namespace phasetree
