// What a kind of density must provide: how dense a medium is at each point, ρ in [0, 1].
//
// A ray's way is divided into stretches, each with a bound on ρ in it, so that thin parts of a medium take few lookups
// and empty ones none (media/varying.hpp).
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <utility>

#include "media/contract.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::tracer {

/// A part of a way, by distances from its origin, and at least the greatest ρ in it.
struct DensityStretch {
    float from, to;
    float greatest;
};

/// * at(x, y, z): ρ at eight points.
/// * bounds(): a box outside of which ρ is 0.
/// * stretches(way): what gives with next() the stretches of a way, in their order, and none after the last. Outside of
///   all stretches ρ is 0. Their length() is the distance from where the first may begin to where the last may end.
template <class D>
concept DensityKind = std::copyable<D> && requires(const D& density, const BatchOfFloats& x, const Way& way) {
    { density.at(x, x, x) } -> std::same_as<BatchOfFloats>;
    { density.bounds() } -> std::same_as<const Bounds&>;
    { density.stretches(way).next() } -> std::same_as<std::optional<DensityStretch>>;
    { density.stretches(way).length() } -> std::same_as<float>;
};

/// The part of a way within a box, from the first distance to the second. If no part is, the second is not greater.
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

struct PointsOfWay {
    BatchOfFloats x, y, z;
};

/// Eight points of a way, by their distances.
inline PointsOfWay points_along(const Way& way, const BatchOfFloats& t) {
    PointsOfWay points;
    for (std::size_t i = 0; i < batch_size; ++i) {
        points.x[i] = way.origin.x + t[i] * way.direction.x;
        points.y[i] = way.origin.y + t[i] * way.direction.y;
        points.z[i] = way.origin.z + t[i] * way.direction.z;
    }
    return points;
}

}  // namespace phasetree::tracer
