// Requirements on a density ρ, which gives the relative density of a medium in [0, 1] at each point.
//
// A ray segment is divided into stretches, each with an upper bound on ρ, so that thin parts of a medium need few
// lookups and empty ones none (media/varying.hpp).
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <utility>

#include "media/contract.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::tracer {

/// A part of a ray segment, by its distances from the segment's origin.
struct DensityStretch {
    float from, to;
    float bound;  ///< upper bound on ρ in it, positive
};

/// Up to eight points.
struct PointBatch {
    BatchOfFloats x, y, z;

    glm::vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// * together: the most efficient number of points per call of at(), at most batch_size.
/// * at(points, count): ρ at the first `count` points. The other points must not be NaN; their results are undefined.
/// * bounds(): a box outside of which ρ is 0.
/// * stretches(way): an object whose next() returns the stretches of the segment in order, and then nullopt. Outside of
///   all stretches, ρ is 0. Its length() is the distance from where the first may begin to where the last may end.
template <class D>
concept DensityKind = std::copyable<D> && requires(const D& density, const PointBatch& points, const Way& way) {
    { density.at(points, D::together) } -> std::same_as<BatchOfFloats>;
    { density.bounds() } -> std::same_as<const Bounds&>;
    { density.stretches(way).next() } -> std::same_as<std::optional<DensityStretch>>;
    { density.stretches(way).length() } -> std::same_as<float>;
};

/// The part of a segment within a box, from the first distance to the second. If there is none, the second distance is
/// not greater than the first. The segment's direction may have any length, and distances are in units of that length.
inline std::pair<float, float> part_within(const Bounds& box, const Way& way) {
    float from = 0.0f, to = way.length;
    for (int i = 0; i < 3; ++i) {
        if (way.direction[i] == 0.0f) {
            if (!(way.origin[i] >= box.low[i] && way.origin[i] <= box.high[i])) return {0.0f, 0.0f};
            continue;
        }
        const float a = (box.low[i] - way.origin[i]) / way.direction[i];
        const float b = (box.high[i] - way.origin[i]) / way.direction[i];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return {from, to};
}

}  // namespace phasetree::tracer
