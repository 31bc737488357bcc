// A number of a material, such as its roughness, that may vary: by a field of the tree, like the colours of field.hpp,
// by an image on a mesh, or per copy, like those of per_copy.hpp.
#pragma once

#include <type_traits>
#include <variant>
#include <vector>

#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"
#include "shading/texture/field.hpp"
#include "shading/texture/field_value.hpp"
#include "shading/texture/mesh_image_number.hpp"
#include "shading/texture/per_copy.hpp"
#include "shading/texture/ramp_of_numbers.hpp"

namespace phasetree::tracer {

struct FieldNumber {
    static constexpr KindInfo info{"field", "A number that depends on a field, such as the distance to other phases."};

    Field of{};
    std::vector<NumberStop> ramp{};
    FieldValue value{};  // set once the field is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = FieldNumber;
        v(&P::of, Parameter{"of", "", "The field, or the name of a shape."});
        v(&P::ramp,
          RampParameter{{"ramp", "m", "Values of the field and the number at each, with interpolation in between."}});
    }
    void prepare() { value = FieldValue(of); }

    float at(const TexturePoint& p) const { return number_at(ramp, value.at(p.position)); }
    float least() const { return least_of(ramp); }
    float greatest() const { return greatest_of(ramp); }
};

/// Those that scene files can use instead of a number.
using NumberTextures = TypeList<FieldNumber, MeshImageNumber, PerCopyNumber>;

using Number = std::variant<float, FieldNumber, MeshImageNumber, PerCopyNumber>;

/// The result of of_texture for a varying number; a constant number is returned unchanged.
template <class OfTexture>
float of_number(const Number& number, const OfTexture& of_texture) {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (std::is_same_v<Kind, float>)
                return kind;
            else
                return of_texture(kind);
        },
        number);
}
/// Whether it is of a kind.
template <class Wanted>
bool has_kind(const Number& number) {
    return std::visit([]<class Kind>(const Kind&) { return std::is_same_v<Kind, Wanted>; }, number);
}
inline float number_at(const Number& number, const TexturePoint& p) {
    return of_number(number, [&](const auto& kind) { return kind.at(p); });
}
inline float least_of(const Number& number) {
    return of_number(number, [](const auto& kind) { return kind.least(); });
}
inline float greatest_of(const Number& number) {
    return of_number(number, [](const auto& kind) { return kind.greatest(); });
}

}  // namespace phasetree::tracer
