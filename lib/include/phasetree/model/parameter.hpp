#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace phasetree {

/// The values that a numeric parameter may take.
struct Limits {
    float low = -std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::max();
    bool low_open = false;
    bool high_open = false;

    constexpr bool contains(float v) const {
        return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
    }
    bool operator==(const Limits&) const = default;
};

namespace limits {
inline constexpr Limits any{};
inline constexpr Limits positive{.low = 0, .low_open = true};
inline constexpr Limits non_negative{.low = 0};
inline constexpr Limits fraction{.low = 0, .high = 1};
}  // namespace limits

namespace detail {
/// For people: "positive", "at least 2 and less than 5".
std::string describe(const Limits&);
}  // namespace detail

/// One parameter of a node, as the scene reader, the writer, the reference page and the checks see it. A node lists
/// its parameters in a static function
///     template <class V> static void parameters(V&& v) { v(&Sphere::radius, {"radius", "m", "Radius.",
///     limits::positive}); }
/// and everything else is derived from that list.
struct Parameter {
    std::string_view name;
    std::string_view unit;  ///< "m", "degrees", "1/m"; empty for a count, a ratio or a child
    std::string_view description;
    Limits limits = limits::any;
    bool optional = false;  ///< if absent, the member's default initialiser stands
    /// Of a list of numbers: a single number may be written in its place, and is a list of one. What that means, the
    /// node and its description say.
    bool one_for_all = false;
};

/// What a node says of itself.
struct NodeInfo {
    std::string_view name;
    std::string_view section;  ///< of the paper; empty for the standard vocabulary of distance fields
    std::string_view equation;
    std::string_view summary;
};

}  // namespace phasetree
