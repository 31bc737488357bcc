// Boxes of doubles in which a formula is enclosed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "enclosure/enclosure.hpp"

namespace phasetree::nodes {

struct BoxOfDoubles {
    std::array<double, 3> low, high;

    std::array<double, 3> middle() const {
        return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
    }
    double half(std::size_t i) const { return (high[i] - low[i]) / 2; }
    std::array<double, 3> halves() const { return {half(0), half(1), half(2)}; }
    Vec3<enclosure::Enclosure> point() const {
        const auto m = middle();
        return {enclosure::Enclosure::coordinate(0, m[0], half(0)), enclosure::Enclosure::coordinate(1, m[1], half(1)),
                enclosure::Enclosure::coordinate(2, m[2], half(2))};
    }
    /// The two halves of the box, divided across the longest side among the axes that count.
    std::pair<BoxOfDoubles, BoxOfDoubles> split(const std::array<bool, 3>& counts = {true, true, true}) const {
        std::size_t longest = 3;
        for (std::size_t i = 0; i < 3; ++i)
            if (counts[i] && (longest == 3 || half(i) > half(longest))) longest = i;
        longest %= 3;
        std::pair<BoxOfDoubles, BoxOfDoubles> both{*this, *this};
        both.first.high[longest] = both.second.low[longest] = middle()[longest];
        return both;
    }
    /// The centre as text for an error message.
    std::string middle_text() const {
        const auto m = middle();
        const auto text = [](double v) {
            std::array<char, 32> buffer;
            std::snprintf(buffer.data(), buffer.size(), "%.3g", v + 0.0);  // −0 + 0 is 0
            return std::string(buffer.data());
        };
        return "(" + text(m[0]) + ", " + text(m[1]) + ", " + text(m[2]) + ")";
    }
};

}  // namespace phasetree::nodes
