// A number of a material, such as its roughness, that may be another at each point: it may follow a field of the tree,
// as the colours of field.hpp do.
#pragma once

#include <algorithm>
#include <span>
#include <variant>
#include <vector>

#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"
#include "shading/texture/field.hpp"
#include "shading/texture/field_value.hpp"
#include "shading/texture/ramp.hpp"

namespace phasetree::tracer {

struct NumberStop {
    float at, number;
};

struct FieldNumber {
    static constexpr KindInfo info{"field",
                                   "A number for each value of a field, such as the distance to other phases."};

    Field of{};
    std::vector<NumberStop> ramp{};
    FieldValue value{};  // of the field, once it is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = FieldNumber;
        v(&P::of, Parameter{"of", "", "The field, or the name of a shape."});
        v(&P::ramp, RampParameter{{"ramp", "m",
                                   "Values of the field and the number at each, between which it is "
                                   "interpolated."}});
    }
    void prepare() { value = FieldValue(of); }

    float at(const glm::vec3& p) const {
        const BetweenStops between = between_stops(std::span(ramp), value.at(p));
        const float low = ramp[between.below].number, high = ramp[between.above].number;
        return low + between.part * (high - low);
    }
    float least() const { return std::ranges::min_element(ramp, {}, &NumberStop::number)->number; }
    float greatest() const { return std::ranges::max_element(ramp, {}, &NumberStop::number)->number; }
};

/// Those that a scene file names in the place of a number.
using NumberTextures = TypeList<FieldNumber>;

using Number = std::variant<float, FieldNumber>;

inline float number_at(const Number& number, const glm::vec3& p) {
    const float* constant = std::get_if<float>(&number);
    return constant ? *constant : std::get<FieldNumber>(number).at(p);
}
inline float least_of(const Number& number) {
    const float* constant = std::get_if<float>(&number);
    return constant ? *constant : std::get<FieldNumber>(number).least();
}
inline float greatest_of(const Number& number) {
    const float* constant = std::get_if<float>(&number);
    return constant ? *constant : std::get<FieldNumber>(number).greatest();
}

}  // namespace phasetree::tracer
