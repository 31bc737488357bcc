// Declares what a program's scene files may contain besides the tree. A kind of thing, such as a sphere light, is a
// plain struct of its parameters, written {"sphere": {…}}:
//
//     struct SphereLightParameters {
//         static constexpr KindInfo info{"sphere", "A ball that emits light."};
//         glm::vec3 centre{};
//         float radius = 1;
//         glm::vec3 radiance{1.0f};
//
//         template <class V>
//         static void parameters(V&& v) {
//             using P = SphereLightParameters;
//             v(&P::centre, Parameter{"centre", "m", "Centre."});
//             v(&P::radius, Parameter{"radius", "m", "Radius.", limits::positive});
//             v(&P::radiance, ColourParameter{{"radiance", "", "Radiance emitted.", limits::non_negative, true}});
//         }
//     };
//
// The reader and its checks (io/read_kind.hpp), the reference page and the schema (io/reference.hpp) are all derived
// from this list. The members' initialisers are the defaults of optional parameters.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/model/parameter.hpp"

namespace phasetree {

/// The description of a kind.
struct KindInfo {
    std::string_view name;     ///< its key in the file
    std::string_view summary;  ///< one or two sentences
    std::string_view equation = {};
};

/// A glm::vec3 that is a colour: [r, g, b] in linear light, or "#rrggbb". The limits apply to each component.
struct ColourParameter : Parameter {};

/// A glm::vec3 of red, green and blue values that is not a displayable colour, such as an absorption: [r, g, b].
struct RgbParameter : Parameter {};

/// A glm::vec3 of which only the direction matters. It must not be zero.
struct DirectionParameter : Parameter {};

/// Thrown by a kind's own code if a parameter is within its limits but conflicts with others, or refers to something
/// unusable. The reader reports the parameter's position in the file or, if the parameter is missing, that it is
/// required.
class ParameterError : public std::runtime_error {
  public:
    /// Where to report the error: at the parameter's value, or at its key if the parameter should not be there at all.
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
