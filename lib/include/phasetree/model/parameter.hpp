#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

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
/// Describe limits as text: "positive", "at least 2 and less than 5".
std::string describe(const Limits&);
}  // namespace detail

/// One parameter of a node. The scene reader, the writer, the reference page and the checks are all derived from the
/// list that a node provides in a static function:
///
///     template <class V>
///     static void parameters(V&& v) {
///         v(&Sphere::radius, Parameter{"radius", "m", "Radius.", limits::positive});
///     }
struct Parameter {
    std::string_view name;
    /// "m" for the scene's unit of length, "degrees", "1/m"; empty for a count, a ratio or a child.
    std::string_view unit;
    std::string_view description;
    Limits limits = limits::any;
    bool optional = false;  ///< if it is missing, the member keeps its default
    /// For a list of numbers: whether a single number may be written instead of a list with one item. The node and the
    /// description say what that means.
    bool one_for_all = false;
};

/// A std::string that is one of a list of names.
struct ChoiceParameter : Parameter {
    std::vector<std::string_view> (*choices)() = nullptr;
};

/// The description of a node in the reference.
struct NodeInfo {
    std::string_view name;
    std::string_view section;  ///< of Galin et al. (model/handle.hpp); empty for standard operations on distance fields
    std::string_view equation;
    std::string_view summary;
};

}  // namespace phasetree
