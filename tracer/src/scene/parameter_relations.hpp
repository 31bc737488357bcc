// Which parameters of a material or mesh exclude or require each other: one list, from which the reader's checks are
// derived, and what the studio removes and adds when a parameter is set.
#pragma once

#include <concepts>
#include <functional>
#include <string_view>
#include <vector>

namespace phasetree::tracer {

/// A parameter that is allowed only beside another one.
struct Requirement {
    std::string_view parameter;
    std::vector<std::string_view> any_of;  ///< one of these must be given, too
    std::string_view initial{};            ///< JSON text: an initial value for the first of these; may be empty
    std::size_t named = 1;                 ///< how many of `any_of` an error message names
};

struct ParameterRelations {
    std::vector<std::vector<std::string_view>> exclusive{};  ///< at most one parameter of each list may be given
    std::vector<Requirement> requirements{};
    /// At least one of these parameters must be given; empty if the kind can do without.
    std::vector<std::string_view> one_of{};
    std::string_view initial{};  ///< JSON text: an initial value for the first parameter of `one_of`
};

const ParameterRelations& relations_of_clear();
const ParameterRelations& relations_of_conductor();
const ParameterRelations& relations_of_thin_glass();
const ParameterRelations& relations_of_bumps();
const ParameterRelations& relations_of_normal_maps();
const ParameterRelations& relations_of_grain();
const ParameterRelations& relations_of_opacity();

/// All relations between parameters of a kind that has a parameter if has(name) is true.
ParameterRelations relations_of(std::string_view type, std::string_view kind,
                                const std::function<bool(std::string_view)>& has);

/// Throws ParameterError if the parameters for which is_given(name) is true exclude each other, or if one is missing
/// that another one requires.
void check_relations(const ParameterRelations& relations, const std::function<bool(std::string_view)>& is_given);

/// The same for the parameters of a kind. A parameter is given if its member, a std::optional or a pointer, has a
/// value.
template <class Kind>
void check_relations_of(const Kind& kind, const ParameterRelations& relations) {
    check_relations(relations, [&](std::string_view name) {
        bool is_given = false;
        Kind::parameters([&](auto member, const auto& parameter) {
            if constexpr (std::constructible_from<bool, decltype(kind.*member)> &&
                          !std::is_arithmetic_v<std::remove_cvref_t<decltype(kind.*member)>>)
                is_given = is_given || (parameter.name == name && static_cast<bool>(kind.*member));
        });
        return is_given;
    });
}

}  // namespace phasetree::tracer
