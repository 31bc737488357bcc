#pragma once

#include <vector>

#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/warps/translate.hpp"

namespace phasetree {

namespace detail {
/// a where n < 0, b where n > 0: (A ∩ N) ∪ (B \ N), united with the consensus A ∩ B. Without the consensus, a wall of
/// zeroes would cross what both have in common:
///     s(a, b) = min(max(a, n), max(b, −n), max(a, b)).
/// s increases with a and b, and −s(−a, −b) = s(a, b), because the minimum of these three maxima is the maximum of the
/// three minima. For objects, aᵢ ≥ −aⱼ and bᵢ ≥ −bⱼ therefore give s(aᵢ, bᵢ) ≥ −s(aⱼ, bⱼ). So I2 (φᵢ + φⱼ ≥ 0 for i ≠
/// j) is preserved, with the vacuum as one more component.
template <class T>
T switched(const T& n, const T& a, const T& b) {
    return min(min(max(a, n), max(b, -n)), max(a, b));
}
template <class T>
Phases<T> switched(const T& n, const Phases<T>& a, const Phases<T>& b) {
    Phases<T> result;
    for_each_phase(a.present | b.present, [&](int i) {
        if (a.has(i) && b.has(i))
            result.set(i, switched(n, a[i], b[i]));
        else
            result.set(i, a.has(i) ? max(a[i], n) : max(b[i], -n));
    });
    return result;
}
}  // namespace detail

/// Where one level is replaced by the next, there is a step as high as the difference between the two, along the sphere
/// around the viewpoint. It is a proper surface, and faces the viewpoint. Each level, and therefore the whole, is
/// 1-Lipschitz with the sign of the level used there.
template <class Child>
struct LevelOfDetail {
    static constexpr bool is_level_of_detail = true;
    static constexpr NodeInfo info{"level_of_detail", "4.1, 7.3",
                                   "min(max(a, n), max(b, −n), max(a, b)),  n = |p − v| − d;  φᵢ and φ₀ alike",
                                   "Levels of detail of a field or an object, from fine to coarse, each used within a "
                                   "range of distances from a viewpoint. Without distances, the finest level is used "
                                   "everywhere, unless distances are chosen for a view (`phasetree render --detail`; "
                                   "in C++, with_levels_of_detail())."};
    std::vector<Child> of{};
    glm::vec3 viewpoint{0};
    std::vector<float> distances{};
    std::vector<float> errors{};

    template <class V>
    static void parameters(V&& v) {
        v(&LevelOfDetail::of, Parameter{"of", "", "The levels, fields or objects, the finest first."});
        v(&LevelOfDetail::viewpoint,
          Parameter{"viewpoint", "m", "The viewpoint from which distances are measured.", limits::any, true});
        v(&LevelOfDetail::distances,
          Parameter{"distances", "m",
                    "Increasing distances at which each level is replaced by the next; one less than there are levels.",
                    limits::positive, true});
        v(&LevelOfDetail::errors,
          Parameter{"errors", "m",
                    "For each coarser level, the distance of its surface from that of the finest level, in increasing "
                    "order. --detail compares these with the size of a pixel. They are trusted, not checked.",
                    limits::positive, true});
    }
    void prepare() const {
        check(distances, "distances");
        check(errors, "errors");
    }
    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        std::size_t i = distances.empty() ? 0 : of.size() - 1;
        auto result = level(d, i, p);
        if (i == 0) return result;
        const typename D::Point from_viewpoint = d.map(Translate::Map{viewpoint}, p, 1.f);
        while (i-- > 0) {
            const typename D::Scalar n = d.primitive(Sphere{.radius = distances[i]}, from_viewpoint);
            result = detail::switched(n, level(d, i, p), result);
        }
        return result;
    }
    PhaseSet phases() const requires(std::is_same_v<Child, Phased>) {
        if (distances.empty()) return phasetree::phases(of.front());
        PhaseSet all;
        for (const Child& each : of) all = all | phasetree::phases(each);
        return all;
    }
    /// s is nowhere less than the smaller of its operands.
    Bounds bounds(BoundsQuery& q, float value) const {
        if (distances.empty()) return q(of.front(), value);
        Bounds all;
        for (const Child& each : of) all = unite(all, q(each, value));
        return all;
    }

  private:
    template <class D>
    auto level(D& d, std::size_t i, const typename D::Point& p) const {
        if constexpr (std::is_same_v<Child, Field>)
            return d.field(of[i], p);
        else
            return d.phases(of[i], p);
    }
    void check(const std::vector<float>& list, const char* name) const {
        const std::string subject = std::string("level_of_detail: \"") + name + "\" ";
        if (list.empty()) return;
        if (list.size() + 1 != of.size()) throw ModelError(subject + "must have one entry fewer than there are levels");
        for (std::size_t i = 1; i < list.size(); ++i)
            if (!(list[i] > list[i - 1])) throw ModelError(subject + "must increase");
    }
};

struct FieldLevelOfDetail : LevelOfDetail<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedLevelOfDetail : LevelOfDetail<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
