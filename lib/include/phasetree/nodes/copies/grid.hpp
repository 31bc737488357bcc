#pragma once

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

template <class Child>
struct Grid : Copies<Grid<Child>, Child> {
    static constexpr NodeInfo info{
        "grid", "", "min over i, j, k of φ(p − (i dx, j dy, k dz)); for objects, later copies replace earlier ones",
        "Copies in rows along x, y and z; the first stays in place. They may overlap. They are ordered by k, then j, "
        "then i."};
    glm::vec3 spacing{1};
    int count_x = 1, count_y = 1, count_z = 1;

    template <class V>
    static void parameters(V&& v) {
        constexpr Limits counts{.low = 1, .high = 10000};
        v(&Grid::of, detail::copied);
        v(&Grid::spacing, Parameter{"spacing", "m", "Distance between copies along x, y and z."});
        v(&Grid::count_x, Parameter{"count_x", "", "Number of copies along x.", counts, true});
        v(&Grid::count_y, Parameter{"count_y", "", "Number of copies along y.", counts, true});
        v(&Grid::count_z, Parameter{"count_z", "", "Number of copies along z.", counts, true});
    }
    void prepare() const {
        if (static_cast<double>(count_x) * count_y * count_z > detail::max_copies)
            throw ModelError("grid: too many copies");
        if (!(glm::length(placement(many() - 1).map.by) < 1e9f)) throw ModelError("grid: the spacing is too large");
    }
    std::size_t many() const { return static_cast<std::size_t>(count_x * count_y * count_z); }
    Placement placement(std::size_t n) const {
        const int i = static_cast<int>(n);
        const glm::ivec3 index(i % count_x, i / count_x % count_y, i / (count_x * count_y));
        return Placement::at(spacing * glm::vec3(index), 0, 1);
    }
};

struct FieldGrid : Grid<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedGrid : Grid<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
