#include "phasetree/io/range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace phasetree {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double decimal(float v) {
    return std::strtod(fmt::format("{}", v).c_str(), nullptr);
}

// In a readable form: 1e15 rather than fifteen zeros.
std::string number(double v) {
    std::string text = fmt::format("{}", v);
    if (const std::size_t plus = text.find("e+"); plus != std::string::npos) return text.erase(plus + 1, 1);
    const std::size_t zeros = text.size() - 1 - std::min(text.find_last_not_of('0'), text.size() - 1);
    return zeros < 10 ? text : fmt::format("{}e{}", text.substr(0, text.size() - zeros), zeros);
}

}  // namespace

Range range_of(const Limits& l) {
    if (l == limits::positive) return Range::positive();
    if (l == limits::non_negative) return Range::not_negative();
    Range r;
    if (l.low > limits::any.low) r.min = decimal(l.low);
    if (l.high < limits::any.high) r.max = decimal(l.high);
    r.min_is_open = l.low_open;
    r.max_is_open = l.high_open;
    return r;
}

std::string describe(const Range& range) {
    if (!range.description.empty()) return std::string(range.description);
    const std::string low = fmt::format("{} {}", range.min_is_open ? "more than" : "at least", number(range.min));
    const std::string high = fmt::format("{} {}", range.max_is_open ? "less than" : "at most", number(range.max));
    if (range.min == -infinity) return high;
    if (range.max == infinity) return low;
    return low + " and " + high;
}

}  // namespace phasetree
