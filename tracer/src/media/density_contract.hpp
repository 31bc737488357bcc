// This is what a kind of density must provide. A density ρ in [0, 1] tells how dense a medium is at each point.
//
// A ray's way is divided into stretches, each with an upper bound on ρ in it, so that thin parts of a medium take few
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

/// A part of a way, by its distances from the way's origin.
struct DensityStretch {
    float from, to;
    float bound;  ///< an upper bound on ρ in it, more than 0
};

/// Up to eight points.
struct PointBatch {
    BatchOfFloats x, y, z;

    glm::vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// * together: how many points are best asked for at once, at most batch_size.
/// * at(points, count): ρ at the first this many points. The other points are numbers, and what is returned for them
/// means
///   nothing.
/// * bounds(): a box outside of which ρ is 0.
/// * stretches(way): an object whose next() returns the way's stretches in their order, and then nothing. Outside of
/// all
///   stretches ρ is 0. Its length() is the distance from where the first may begin to where the last may end.
template <class D>
concept DensityKind = std::copyable<D> && requires(const D& density, const PointBatch& points, const Way& way) {
    { density.at(points, D::together) } -> std::same_as<BatchOfFloats>;
    { density.bounds() } -> std::same_as<const Bounds&>;
    { density.stretches(way).next() } -> std::same_as<std::optional<DensityStretch>>;
    { density.stretches(way).length() } -> std::same_as<float>;
};

/// The part of a way within a box, from the first distance to the second. If no part is, the second is not greater. The
/// way's direction may have any length, which distances are counted in.
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
