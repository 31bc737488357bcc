#pragma once

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

/// Maps p to the corresponding point in the lattice cell around `centre`. The map jumps at the faces of lattice cells,
/// so its slope is unbounded; the program records `jump` as its slope instead. In boxes that touch no such face,
/// pruning divides the slope by `jump` again (src/pruning/jumps.cpp).
struct FoldMap {
    glm::vec3 centre{0};
    glm::vec3 spacing{1};
    glm::vec3 inverse{1};  ///< 0 along an axis without copies

    static constexpr float jump = 0x1p40f;

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        return {folded(p.x, 0), folded(p.y, 1), folded(p.z, 2)};
    }

    /// See FoldingMap.
    float finest_spacing() const {
        float finest = Bounds::infinity;
        for (int axis = 0; axis < 3; ++axis)
            if (spacing[axis] > 0) finest = std::min(finest, spacing[axis]);
        return finest;
    }
    bool jumps_between(int axis, double low, double high) const {
        const auto cell = [&](double at) {
            return std::floor((at - static_cast<double>(centre[axis])) * static_cast<double>(inverse[axis]) + 0.5);
        };
        return cell(low) != cell(high);
    }

  private:
    template <class T>
    T folded(const T& x, int axis) const {
        return x - floor((x - centre[axis]) * inverse[axis] + 0.5f) * spacing[axis];
    }
};

/// The distance to the boxes around the copies, which repeat without end. A box is centred in its cell, so it is the
/// nearest one throughout the cell, and the distance is exact and continuous.
struct FoldedBox {
    FoldMap fold{};
    glm::vec3 half{1};

    template <class T>
    T distance(const Vec3<T>& p) const {
        return box_distance(fold(p) - fold.centre, half);
    }
};

/// Endless copies for only a few more instructions than one copy. Let b be the distance to the copies' boxes, and g the
/// smallest clearance between a box and its cell's face. Then b ≥ g on the faces, where the folded field jumps, and
///     max(b, min(f, 2g − b))
/// is b wherever b ≥ g. It is therefore continuous and 1-Lipschitz, and has the sign of f. This is why copies must not
/// touch their cells' faces; see "Fields above a discontinuity" in lib/README.md.
template <class Child>
struct EndlessGrid {
    static constexpr NodeInfo info{
        "endless_grid", "",
        "max(b, min(φ(q), 2g − b)),  q = p − s ⌊(p − c)/s + ½⌋,  b = distance to the copies' "
        "boxes,  g = half the smallest gap between boxes",
        "Copies repeated endlessly along the axes; their bounding boxes must not touch."};
    static constexpr bool has_copies = true;  ///< with_levels_of_detail() leaves the levels below it unchanged
    using Parts = TypeList<FoldMap, FoldedBox>;
    Child of{};
    glm::vec3 spacing{0};
    FoldedBox boxes{};    ///< derived
    float clearance = 0;  ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&EndlessGrid::of, detail::copied);
        v(&EndlessGrid::spacing,
          Parameter{"spacing", "m", "Distance between copies along x, y and z; 0 for no repetition along that axis.",
                    limits::non_negative});
    }
    void prepare() {
        const Bounds b = phasetree::bounds(of);
        if (b.empty()) throw ModelError("endless_grid: the child is empty");
        if (!b.finite()) detail::throw_unbounded("endless_grid: the child", of);
        boxes.fold = {b.centre(), spacing, glm::vec3(0)};
        boxes.half = b.extent() * (0.5f * (1 + 1e-6f));
        clearance = Bounds::infinity;
        for (int i = 0; i < 3; ++i) {
            if (spacing[i] == 0) continue;
            boxes.fold.inverse[i] = 1 / spacing[i];
            clearance = std::min(clearance, 0.5f * spacing[i] - boxes.half[i]);
            if (!(spacing[i] < 1e9f)) throw ModelError("endless_grid: the spacing is too large");
            if (!(clearance > 1e-4f * spacing[i]))
                throw ModelError(
                    "endless_grid: the copies touch; increase \"spacing\" so that there is space between their boxes");
        }
        if (!std::isfinite(clearance)) throw ModelError("endless_grid: \"spacing\" is zero along every axis");
    }
    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        const auto b = d.primitive(boxes, p);
        const typename D::Point q = d.map(boxes.fold, p, FoldMap::jump);
        if constexpr (std::is_same_v<Child, Field>) {
            return guarded(b, d.field(of, q), 2 * clearance);
        } else {
            auto a = d.phases(of, q);
            for_each_phase(a.present, [&](int i) {
                a.set(i, i == 0 ? -guarded(b, -a[i], 2 * clearance) : guarded(b, a[i], 2 * clearance));
            });
            return a;
        }
    }
    PhaseSet phases() const { return phasetree::phases(of); }
    Bounds bounds(BoundsQuery& q, float level) const {
        const glm::vec3 half = boxes.half + level;
        Bounds all{boxes.fold.centre - half, boxes.fold.centre + half};
        if (all.empty()) return all;
        for (int i = 0; i < 3; ++i)
            if (spacing[i] > 0) {
                all.low[i] = -Bounds::infinity;
                all.high[i] = Bounds::infinity;
            }
        return q.placed(all);
    }
};

struct FieldEndlessGrid : EndlessGrid<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedEndlessGrid : EndlessGrid<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
