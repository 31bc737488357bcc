#pragma once

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

template <class Child>
struct PolarArray : Copies<PolarArray<Child>, Child> {
    static constexpr NodeInfo info{"polar_array", "",
                                   "min over i < n of φ(R(−i a/n) p); for objects, later copies replace earlier ones",
                                   "Copies rotated about the z axis by equal angles."};
    int count = 6;
    float angle = 360;

    template <class V>
    static void parameters(V&& v) {
        v(&PolarArray::of, detail::copied);
        v(&PolarArray::count, Parameter{"count", "", "Number of copies.", {.low = 1, .high = 10000}});
        v(&PolarArray::angle,
          Parameter{"angle", "degrees", "Total angle: copy i is rotated by i/count of it. Default: a full turn.",
                    limits::any, true});
    }
    std::size_t many() const { return static_cast<std::size_t>(count); }
    Placement placement(std::size_t i) const {
        return Placement::at(glm::vec3(0),
                             std::fmod(static_cast<double>(angle), 360.0 * count) * static_cast<double>(i) / count, 1);
    }
};

struct FieldPolarArray : PolarArray<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedPolarArray : PolarArray<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
