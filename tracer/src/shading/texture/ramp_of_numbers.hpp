// A ramp from numbers to numbers.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "shading/texture/ramp.hpp"

namespace phasetree::tracer {

struct NumberStop {
    float at, number;
};

inline float number_at(const std::vector<NumberStop>& ramp, float value) {
    const BetweenStops between = between_stops(std::span(ramp), value);
    const float low = ramp[between.below].number, high = ramp[between.above].number;
    return low + between.part * (high - low);
}
inline float least_of(const std::vector<NumberStop>& ramp) {
    return std::ranges::min_element(ramp, {}, &NumberStop::number)->number;
}
inline float greatest_of(const std::vector<NumberStop>& ramp) {
    return std::ranges::max_element(ramp, {}, &NumberStop::number)->number;
}

}  // namespace phasetree::tracer
