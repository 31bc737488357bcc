#pragma once

#include <glm/trigonometric.hpp>
#include <vector>

#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"

/// What the nodes share that put copies of one child in many places. In memory the child is there once; in the program
/// each copy has its instructions, so that pruning deletes a copy where it does not matter. Copies of a field are
/// united, of an object each replaces those before it, as in `under`. So copies may overlap, and there is no seam
/// between them.
namespace phasetree {

/// p ↦ R(−a)(p − v)/s about the z axis: the inverse of scaling by s, then turning by a, then moving by v.
struct PlacementMap {
    glm::vec3 by{0};
    float cosine = 1;  ///< cos a / s
    float sine = 0;    ///< sin a / s
    float inverse = 1;

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        const Vec3<T> q = p - by;
        return {q.x * cosine + q.y * sine, q.y * cosine - q.x * sine, q.z * inverse};
    }
};

/// Where a copy stands.
struct Placement {
    PlacementMap map;
    float scale = 1;

    /// `turn` in degrees.
    static Placement at(const glm::vec3& by, double turn, float scale) {
        const double a = glm::radians(turn), s = scale;
        Placement result{{by, static_cast<float>(std::cos(a) / s), static_cast<float>(std::sin(a) / s), 1 / scale},
                         scale};
        if (!std::isfinite(result.map.inverse)) throw ModelError("a copy's scale is too small");
        return result;
    }
    bool is_moved_only() const { return map.cosine == 1 && map.sine == 0 && scale == 1; }
    Bounds image(const Bounds& b) const {
        if (b.empty()) return b;
        if (map.sine == 0 && map.cosine > 0) return {b.low * scale + map.by, b.high * scale + map.by};
        const Bounds turned = image_of_corners(b, [&](const glm::vec3& p) {
            const float c = map.cosine * scale, s = map.sine * scale;
            return glm::vec3(p.x * c - p.y * s, p.x * s + p.y * c, p.z) * scale + map.by;
        });
        return turned.inflated(turned.finite() ? 1e-6f * (turned.diagonal() + glm::length(turned.centre())) : 0.f);
    }
};

/// Copies of a field or an object: a node's base that evaluates what `placements` says.
template <class Child>
struct Copies {
    using Parts = TypeList<PlacementMap>;
    Child of;
    std::vector<Placement> placements;  ///< derived

    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        auto result = one(d, placements.front(), p);
        for (std::size_t i = 1; i < placements.size(); ++i) {
            if constexpr (std::is_same_v<Child, Field>)
                result = min(result, one(d, placements[i], p));
            else
                result = detail::under(result, one(d, placements[i], p));
        }
        return result;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        Bounds all;
        for (const Placement& at : placements) all = unite(all, at.image(q(of, level / at.scale)));
        return all;
    }

  private:
    template <class D>
    auto one(D& d, const Placement& at, const typename D::Point& p) const {
        const typename D::Point q = at.is_moved_only() ? d.map(Translate::Map{at.map.by}, p, 1.f)
                                                       : d.map(at.map, p, at.map.inverse * (1 + 2e-7f));
        if constexpr (std::is_same_v<Child, Field>) {
            const auto f = d.field(of, q);
            return at.scale == 1 ? f : f * at.scale;
        } else {
            auto a = d.phases(of, q);
            if (at.scale != 1) for_each_phase(a.present, [&](int i) { a.set(i, a[i] * at.scale); });
            return a;
        }
    }
};

namespace detail {
inline constexpr Parameter copied{"of", "", "What is copied: a field or an object."};
/// More copies than that would not pass the limit of instructions anyway.
inline constexpr int most_copies = 500'000;
}  // namespace detail

}  // namespace phasetree
