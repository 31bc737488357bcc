#pragma once

#include "phasetree/nodes/proxies/guard.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree {

/// The result is exact (guard.hpp): if the volume contains the child, labels and the zero set are the child's. The
/// child's own box, which is used if no volume is given, is guaranteed to contain it. For a given volume the author
/// must ensure this; anything that sticks out is cut off.
template <class Child>
struct BoundingVolume {
    static constexpr NodeInfo info{"bounding_volume", "4.1, 7.3",
                                   "max(b, min(f, 2m − b));  φᵢ likewise,  φ₀ = min(−b, max(a₀, b − 2m))",
                                   "A field or an object with a bounding volume, whose distance replaces it far away. "
                                   "Parts outside the volume are cut off."};
    Child of{};
    Field volume{};
    float margin = 0.1f;
    BoundingBox box{};  ///< derived: the child's, if there is no volume

    template <class V>
    static void parameters(V&& v) {
        v(&BoundingVolume::of, Parameter{"of", "", "The field or object to bound."});
        v(&BoundingVolume::volume,
          Parameter{"volume", "", "The bounding volume, a field. Default: the bounding box.", limits::any, true});
        v(&BoundingVolume::margin, detail::guard_margin);
    }
    void prepare() {
        if (volume) return;
        const Bounds b = phasetree::bounds(of);
        if (b.empty()) throw ModelError("bounding_volume: the child is empty");
        if (!b.finite())
            detail::throw_unbounded("bounding_volume: the child", of, ", so it has no bounding box; give a \"volume\"");
        box = {b.centre(), b.extent() * (0.5f * (1 + 1e-6f))};
    }
    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        const typename D::Scalar b = volume ? d.field(volume, p) : d.primitive(box, p);
        if constexpr (std::is_same_v<Child, Field>)
            return detail::guarded_by(b, margin, [&] { return d.field(of, p); });
        else
            return detail::object_guarded_by(b, margin, phasetree::phases(of), vacuum.index,
                                             [&] { return d.phases(of, p); });
    }
    /// The object's phases, and the vacuum outside the volume.
    PhaseSet phases() const requires(std::is_same_v<Child, Phased>) {
        return phasetree::phases(of) | PhaseSet::of(vacuum);
    }
    /// At the margin and beyond, only the volume matters.
    Bounds bounds(BoundsQuery& q, float level) const {
        const auto of_volume = [&] {
            const glm::vec3 half = box.half + level;
            return volume ? q(volume, level) : q.placed(Bounds{box.centre - half, box.centre + half});
        };
        if (level >= margin) return of_volume();
        return q.cut([&] { return intersect(q(of, level), of_volume()); });
    }
};

struct FieldBoundingVolume : BoundingVolume<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedBoundingVolume : BoundingVolume<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
