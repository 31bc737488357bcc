// Piecewise-linear ramps from numbers to numbers or colours. Beyond the first and last stop they are constant.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace phasetree::tracer {

/// Two neighbouring stops, and the fraction of the way from the first to the second, in [0, 1].
struct BetweenStops {
    std::size_t below, above;
    float part;
};

/// `stops` have a non-decreasing member `at`; there is at least one.
template <class Stop>
BetweenStops between_stops(std::span<const Stop> stops, float value) {
    const auto after = std::ranges::find_if(stops, [&](const Stop& stop) { return stop.at > value; });
    const auto above = static_cast<std::size_t>(after - stops.begin());
    if (above == 0) return {0, 0, 0.0f};
    if (above == stops.size()) return {above - 1, above - 1, 0.0f};
    const float low = stops[above - 1].at, high = stops[above].at;
    return {above - 1, above, std::clamp((value - low) / (high - low), 0.0f, 1.0f)};
}

}  // namespace phasetree::tracer
