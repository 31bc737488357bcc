// A warp deforms space: ω(A) has Φ(p) = Φ_A(ω⁻¹(p)) / λ where λ ≥ sup ‖J‖ for the Jacobian J of ω⁻¹ (Galin et al.,
// Section 6). A warp is a struct with its parameters and
//
//     Map map() const                 p ↦ ω⁻¹(p), a PointMap: one instruction of the program
//     float value_scale() const       1/λ
//     Bounds image(Bounds) const      a box around ω(box)
//
// and, if it is neither affine nor local, for bounds by directions (BoundsQuery::through),
//
//     dvec3 towards(dvec3 d) const,  double beyond(dvec3 d) const
//
// Warped<Warp, Child> applies it to fields and objects alike.
//
// If ‖J‖ is bounded only on a part of space, the warp is `local`. It then receives the child's bounds first, through
//
//     void fit(const Bounds& child)   throws ModelError if the child is unbounded
//
// and the supremum is taken over ω(those bounds). Points outside are first projected onto that box. The projection
// never increases distances, so Φ∘ω⁻¹∘clamp / λ is 1-Lipschitz everywhere. Because it stays small far away, the
// distance b to the bounds takes over where it is larger:
//
//     φᵢ ← max(b, φᵢ),   φ₀ ← min(−b, φ₀).
#pragma once

#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/phased/under.hpp"

namespace phasetree {

template <class W>
concept LocalWarp = requires {
    W::local;
};

/// The distance to an axis-aligned box with any centre. It bounds the result of a local warp.
struct BoundingBox {
    static constexpr bool is_convex = true;
    glm::vec3 centre{0};
    glm::vec3 half{1};

    template <class T>
    T distance(const Vec3<T>& p) const {
        return box_distance(p - centre, half);
    }
};

/// Maps a point to the nearest point of a box.
struct ClampToBox {
    glm::vec3 low{-1};
    glm::vec3 high{1};

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        return {clamp(p.x, T(low.x), T(high.x)), clamp(p.y, T(low.y), T(high.y)), clamp(p.z, T(low.z), T(high.z))};
    }
};

template <class Warp, class Child>
struct Warped {
    static constexpr NodeInfo info = Warp::info;
    static constexpr bool for_fields = std::is_same_v<Child, Field>;
    Warp warp;
    Child of;
    BoundingBox bound;  ///< local warps only

    template <class V>
    static void parameters(V&& v) {
        Warp::parameters([&](auto member, const Parameter& p) { v(Through<decltype(member)>{member}, p); });
        v(&Warped::of, Parameter{"of", "", "The field or object to warp."});
    }
    /// Accesses a member of the warp through the node.
    template <class Member>
    struct Through {
        Member member;
        friend decltype(auto) access(auto& node, Through t) { return (node.warp.*(t.member)); }
    };

    void prepare() {
        phasetree::prepare(warp);
        if constexpr (LocalWarp<Warp>) {
            const Bounds inner = phasetree::bounds(of);
            if (!inner.finite()) detail::throw_unbounded(std::string(info.name) + ": the child", of);
            warp.fit(inner);
            const Bounds outer = warp.image(inner);
            bound = {outer.centre(), outer.extent() * 0.5f};
        }
    }
    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        typename D::Point inside = p;
        if constexpr (LocalWarp<Warp>) {
            inside = d.map(ClampToBox{bound.centre - bound.half, bound.centre + bound.half}, p, 1.f);
        }
        const typename D::Point q = d.map(warp.map(), inside, 1.f / warp.value_scale());
        const float k = warp.value_scale();
        const auto scaled = [&](const auto& value) { return k == 1.f ? value : value * k; };
        if constexpr (for_fields) {
            auto f = scaled(d.field(of, q));
            if constexpr (LocalWarp<Warp>) f = max(d.primitive(bound, p), f);
            return f;
        } else {
            auto a = d.phases(of, q);
            for_each_phase(a.present, [&](int i) { a.set(i, scaled(a[i])); });
            if constexpr (LocalWarp<Warp>) {
                const auto b = d.primitive(bound, p);
                for_each_phase(a.present, [&](int i) { a.set(i, i == 0 ? min(-b, a[i]) : max(b, a[i])); });
            }
            return a;
        }
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        if constexpr (LocalWarp<Warp>) {
            // max(b, ·) ≤ level lies within b ≤ level, and a box's field is exact outside.
            const glm::vec3 half = bound.half + level;
            return q.placed(Bounds{bound.centre - half, bound.centre + half});
        } else {
            const auto of_child = [&] { return q(of, level / warp.value_scale()); };
            if (q.is_by_boxes()) return warp.image(of_child());
            if constexpr (AffinePointMap<typename Warp::Map>) {
                const AffineMap::Inverse map = warp.map().affine().inverse();
                return q.through(map.matrix, map.by, of_child);
            } else {
                return q.through([&](const glm::dvec3& d) { return warp.towards(d); },
                                 [&](const glm::dvec3& d) { return warp.beyond(d); }, of_child);
            }
        }
    }
};

/// Makes a warped field a field node.
template <class Warp>
struct WarpedField : Warped<Warp, Field> {
    static constexpr bool is_field_node = true;
};
/// Makes a warped object an object node. An object can be warped in part: W, the warped object of the chosen phases, is
/// put over or under R, the unwarped rest. The paper's D(A, k) is the special case of a single phase k in `over`.
template <class Warp>
struct WarpedPhased : Warped<Warp, Phased> {
    static constexpr bool is_phased_node = true;
    using Whole = Warped<Warp, Phased>;
    PhaseSet over{}, under{};

    template <class V>
    static void parameters(V&& v) {
        Whole::parameters(v);
        v(&WarpedPhased::over, Parameter{"over", "",
                                         "For an object: warp only these phases, and let them replace the others. By "
                                         "default, all phases are warped.",
                                         limits::any, true});
        v(&WarpedPhased::under, Parameter{"under", "",
                                          "For an object: warp only these phases, and let the others replace them. By "
                                          "default, all phases are warped.",
                                          limits::any, true});
    }
    void prepare() {
        Whole::prepare();
        const std::string name(Whole::info.name);
        if (!over.empty() && !under.empty())
            throw ModelError(name + ": \"over\" and \"under\" cannot be combined; remove one of them");
        if (chosen().contains(vacuum)) throw ModelError(name + ": the vacuum cannot be warped on its own");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto warped = Whole::evaluate(d, p);
        if (chosen().empty()) return warped;
        warped = detail::emptied(std::move(warped), ~chosen().bits);
        const auto rest = detail::emptied(d.phases(this->of, p), chosen().bits);
        return under.empty() ? detail::under(rest, warped) : detail::under(warped, rest);
    }
    PhaseSet phases() const {
        const PhaseSet there = phasetree::phases(this->of);
        const std::uint64_t materials = there.bits & ~std::uint64_t{1};
        // If only some of the materials are warped, the result has a vacuum even if the object has none, because the
        // warped phases may vacate space.
        const bool is_split = (materials & chosen().bits) != 0 && (materials & ~chosen().bits) != 0;
        return is_split ? there | PhaseSet::of(vacuum) : there;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        const Bounds warped = Whole::bounds(q, level);
        return chosen().empty() ? warped : unite(warped, q(this->of, level));
    }

  private:
    PhaseSet chosen() const { return over | under; }
};

/// Apply a warp to a field or an object: `warped(Translate{{1, 0, 0}}, ball)`.
template <class Warp>
Field warped(Warp warp, Field child) {
    return WarpedField<Warp>{{warp, std::move(child), {}}};
}
template <class Warp>
Phased warped(Warp warp, Phased child) {
    return WarpedPhased<Warp>{{warp, std::move(child), {}}, {}, {}};
}

}  // namespace phasetree
