#pragma once

/// How a program declares what its scene files may contain beside the tree. A kind of thing, such as a sphere light, is
/// a plain struct of what the file gives of it, written {"sphere": {…}}:
///
///     struct SphereLightParameters {
///         static constexpr KindInfo info{"sphere", "A ball that shines."};
///         glm::vec3 centre{};
///         float radius = 1;
///         glm::vec3 radiance{1.0f};
///         template <class V>
///         static void parameters(V&& v) {
///             using P = SphereLightParameters;
///             v(&P::centre, Parameter{"centre", "m", "Its centre."});
///             v(&P::radius, Parameter{"radius", "m", "Its radius.", limits::positive});
///             v(&P::radiance, ColourParameter{{"radiance", "", "What it emits.", limits::non_negative, true}});
///         }
///     };
///
/// From this list follow the reader with its checks (io/read_kind.hpp), the reference page and the schema
/// (io/reference.hpp). The members' initialisers are the defaults of what is optional.

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/model/parameter.hpp"

namespace phasetree {

/// What a kind says of itself.
struct KindInfo {
    std::string_view name;     ///< its key in the file
    std::string_view summary;  ///< a sentence or two
    std::string_view equation = {};
};

/// A glm::vec3 that is a colour: [r, g, b] in linear light, or "#rrggbb". The limits hold for each component.
struct ColourParameter : Parameter {};

/// A glm::vec3 of numbers for red, green and blue that is no colour to look at, such as an absorption: [r, g, b].
struct RgbParameter : Parameter {};

/// A glm::vec3 of which only the direction counts, so that it must not be zero.
struct DirectionParameter : Parameter {};

/// A std::string that is one of some names.
struct ChoiceParameter : Parameter {
    std::vector<std::string_view> (*choices)() = nullptr;
};

/// Thrown by a kind's own code: this parameter is within its limits, but does not go with the others, or names what
/// cannot be used. A reader shows where it stands in the file; where it is missing, that it is needed.
class ParameterError : public std::runtime_error {
  public:
    /// Whether the parameter's value is wrong, or that it is there at all.
    enum class Place { value, key };

    ParameterError(std::string_view parameter, const std::string& message, Place place = Place::value)
        : std::runtime_error(message), parameter_(parameter), place_(place) {}

    const std::string& parameter() const noexcept { return parameter_; }
    Place place() const noexcept { return place_; }

  private:
    std::string parameter_;
    Place place_;
};

}  // namespace phasetree
