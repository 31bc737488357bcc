#pragma once

#include <span>
#include <vector>

#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A BlobTree: a sum of skeletons with compact support. With dᵢ the distance to skeleton i, gᵢ its falloff(dᵢ, Rᵢ) and
/// b = Σ wᵢ gᵢ, the solid is b > T.
///
/// *Slope.* (T − b)/λ is 1-Lipschitz for λ ≥ sup ‖∇b‖. Summing the bounds of the falloffs would give a valid λ, but one
/// many times too large if no two skeletons are steep at the same place. blob_slope() (src/preparation/blob.cpp) bounds
/// Σ wᵢ |gᵢ′| over all of space by subdivision.
///
/// *Outside.* The paper (Galin et al., Section 9.2) uses the distance to the support, min (dᵢ − Rᵢ), as a bound on the
/// distance far away. A larger bound is also valid: if b ≥ T, the weighted mean Σ wᵢ gᵢ/Σw is at least T/Σw. So some gᵢ
/// ≥ T/Σw, that is, dᵢ ≤ rᵢ where gᵢ(rᵢ) = T/Σw. So max((T − b)/λ, min (dᵢ − rᵢ)) has the sign of T − b, and slope 1
/// far away. min (dᵢ − rᵢ) is larger than the paper's bound because rᵢ < Rᵢ.
struct Blob {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"blob", "7.5, 9.2",
                                   "max((T − Σ wᵢ (1 − (dᵢ/Rᵢ)²)³)/λ, min dᵢ − rᵢ),  rᵢ = Rᵢ √(1 − ∛(T/Σw)),  "
                                   "λ ≥ sup ‖∇Σ‖",
                                   "A BlobTree: the skeletons are points, a chain of segments and other fields. Their "
                                   "contributions have compact support, add up, and blend into each other."};
    /// The primitive for the distance to a point.
    struct Point {
        glm::vec3 at{0};

        template <class T>
        T distance(const Vec3<T>& p) const {
            return length(p - at);
        }
    };
    /// The primitive for the distance to a segment.
    struct Segment {
        glm::vec3 from{0};
        glm::vec3 along{0, 0, 1};
        float inverse = 1;  ///< 1/|along|², 0 for a point

        template <class T>
        T distance(const Vec3<T>& p) const {
            const Vec3<T> q = p - from;
            const T t = clamp(dot(q, along) * inverse, T(0.f), T(1.f));
            return length(Vec3<T>{q.x - t * along.x, q.y - t * along.y, q.z - t * along.z});
        }
    };
    using Parts = TypeList<Point, Segment>;

    std::vector<glm::vec3> points{};
    std::vector<glm::vec3> polyline{};
    std::vector<Field> of{};
    std::vector<float> radii{};
    std::vector<float> weights{};
    float threshold = 0.5f;
    float slope = 1;                  ///< λ, derived
    float level = 0.5f;               ///< T/Σw, derived
    std::vector<Segment> segments{};  ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Blob::points, Parameter{"points", "m", "Point skeletons.", limits::any, true});
        v(&Blob::polyline,
          Parameter{"polyline", "m", "A chain of segments, which is a single skeleton.", limits::any, true});
        v(&Blob::of,
          Parameter{"of", "", "Fields that serve as skeletons. The distance is 0 inside them.", limits::any, true});
        v(&Blob::radii, Parameter{"radii", "m",
                                  "Radius of influence of each skeleton: one number for all, or one for each of the "
                                  "points, then the polyline, then the fields.",
                                  limits::positive, false, true});
        v(&Blob::weights, Parameter{"weights", "", "Weights of the skeletons, in the same order; default 1.",
                                    limits::positive, true, true});
        v(&Blob::threshold,
          Parameter{"threshold", "", "Threshold T; a larger one makes the solid smaller.", limits::positive, true});
    }

    /// The number of skeletons.
    std::size_t count() const { return points.size() + (polyline.empty() ? 0 : 1) + of.size(); }
    float radius(std::size_t i) const { return radii[radii.size() == 1 ? 0 : i]; }
    float weight(std::size_t i) const { return weights.empty() ? 1.f : weights[weights.size() == 1 ? 0 : i]; }

    void prepare();

    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        std::optional<typename D::Scalar> sum, nearest;
        std::size_t i = 0;
        const auto add = [&](const typename D::Scalar& distance) {
            const float w = weight(i), r = radius_at(radius(i), level);
            auto g = falloff(distance, radius(i));
            if (w != 1) g = g * w;
            sum = sum ? *sum + g : g;
            nearest = nearest ? min(*nearest, distance - r) : distance - r;
            ++i;
        };
        for (const glm::vec3& at : points) add(d.primitive(Point{at}, p));
        if (!segments.empty()) {
            typename D::Scalar chain = d.primitive(segments[0], p);
            for (std::size_t k = 1; k < segments.size(); ++k) chain = min(chain, d.primitive(segments[k], p));
            add(chain);
        }
        for (const Field& f : of) add(d.field(f, p));
        return far_bound(d.one_lipschitz((threshold - *sum) * (1 / slope), p), *nearest);
    }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const { return std::span(segments).size_bytes(); }
    Bounds bounds(BoundsQuery& q, float at_level) const {
        Bounds all;
        std::size_t i = 0;
        const auto reached = [&] { return radius_at(radius(i++), level) + at_level; };
        const auto add = [&](const glm::vec3& v, float by) {
            if (by >= 0)
                all = unite(all, q.placed(Bounds{v, v}.inflated(by), [&](const glm::dvec3& d) {
                    return glm::dot(d, glm::dvec3(v)) + glm::length(d) * static_cast<double>(by);
                }));
        };
        for (const glm::vec3& v : points) add(v, reached());
        if (!polyline.empty())
            for (const float by = reached(); const glm::vec3& v : polyline) add(v, by);
        for (const Field& f : of) all = unite(all, q(f, reached()));
        return all;
    }

    /// The distance at which falloff(·, R) falls below the level.
    static float radius_at(float radius, float level) {
        return radius * std::sqrt(1 - portable::cbrt(level)) * (1 + 1e-6f);
    }
};

}  // namespace phasetree
