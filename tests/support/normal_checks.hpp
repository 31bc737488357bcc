#pragma once

/// Checks the normals of crossings against differences of the oracle's components in double (set_algebra.hpp).

#include <algorithm>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/affine.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace phasetree::tests {

/// The direction in which a component increases; zero if there is none.
inline glm::dvec3 direction_of_growth(const Phased& object, const glm::dvec3& p, Phase phase, double step) {
    glm::dvec3 g;
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 side(0);
        side[i] = step;
        g[i] = values(object, p + side)[phase.index] - values(object, p - side)[phase.index];
    }
    return glm::length(g) > 0 ? glm::normalize(g) : g;
}

enum class Verdict { right, by_an_edge, wrong };

/// A crossing of a ray, and the normal that it was given.
struct NormalCheck {
    const Phased& object;
    const Crossing& crossing;
    glm::dvec3 direction;
    double resolution;
    glm::dvec3 normal;

    static constexpr double tolerance = 2e-3;

    /// The normal, unless an edge, or the other side of something thin, is nearer than forty resolutions.
    Verdict verdict() const {
        const glm::dvec3 expected = growth(glm::dvec3(crossing.p_from), crossing.from);
        if (glm::length(normal - turned_along(expected)) < tolerance) return Verdict::right;
        return glm::length(expected) > 0 && is_smooth(expected) ? Verdict::wrong : Verdict::by_an_edge;
    }

    /// As above where an edge may be near: a normal between those of the surrounding faces is right.
    Verdict verdict_among_faces() const {
        if (verdict() == Verdict::right) return Verdict::right;
        const std::vector<glm::dvec3> around = normals_around();
        double narrowest = 1;
        for (const glm::dvec3& m : around)
            for (const glm::dvec3& n : around) narrowest = std::min(narrowest, glm::dot(m, n));
        for (const glm::dvec3& m : around)
            if (glm::dot(normal, m) < narrowest - 1e-5) return Verdict::wrong;
        return narrowest > 1 - 1e-5 ? Verdict::right : Verdict::by_an_edge;
    }

  private:
    glm::dvec3 growth(const glm::dvec3& p, Phase phase) const {
        return direction_of_growth(object, p, phase, 0.01 * resolution);
    }
    glm::dvec3 middle() const { return 0.5 * (glm::dvec3(crossing.p_from) + glm::dvec3(crossing.p_to)); }

    /// Because of rounding, a ray that creeps along an interface may cross it against its normal, or cross it several
    /// times. The normal that is returned still points along the ray.
    glm::dvec3 turned_along(const glm::dvec3& n) const {
        const double cosine = glm::dot(n, direction);
        if (cosine >= 0) return n;
        return cosine > -0.1 ? glm::normalize(n - cosine * direction) : -n;
    }

    /// Whether within forty resolutions, the only interface is one between these phases with this normal.
    bool is_smooth(const glm::dvec3& n) const {
        const glm::dvec3 u =
            glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(n, u);
        for (int i = 0; i < 8; ++i)
            for (const double height : {-6.0, -2.0, 2.0, 6.0}) {
                const double aside = (i % 2 == 0 ? 12 : 40) * resolution, turn = 0.25 * 3.14159265358979 * i;
                const glm::dvec3 q =
                    middle() + aside * (std::cos(turn) * u + std::sin(turn) * v) + height * resolution * n;
                const bool is_before = height < 0;
                const Phase phase = is_before ? crossing.from : crossing.to;
                if (label(object, q) != phase) return false;
                const glm::dvec3 m = (is_before ? 1.0 : -1.0) * growth(q, phase);
                if (glm::length(m - n) > tolerance) return false;
            }
        return true;
    }

    /// The direction in which `from` increases and `to` decreases, within a few resolutions.
    std::vector<glm::dvec3> normals_around() const {
        std::vector<glm::dvec3> result;
        Random rng(5);
        for (int i = 0; i < 160; ++i) {
            const glm::dvec3 q = middle() + (i % 2 == 0 ? 6 : 16) * resolution * glm::dvec3(rng.direction());
            const Phase here = label(object, q);
            if (here != crossing.from && here != crossing.to) continue;
            const glm::dvec3 g = growth(q, here);
            if (glm::length(g) > 0) result.push_back(here == crossing.from ? g : -g);
        }
        return result;
    }
};

/// The number of normals with each verdict, and descriptions of what was wrong.
struct NormalTotals {
    std::size_t right = 0, by_an_edge = 0, wrong = 0;
    std::string complaints;

    void count(const NormalCheck& c, Verdict v, std::string_view what) {
        (v == Verdict::right ? right : v == Verdict::wrong ? wrong : by_an_edge) += 1;
        if (v != Verdict::wrong || wrong > 5) return;
        const auto text = [](const glm::dvec3& p) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", p.x, p.y, p.z); };
        complaints +=
            fmt::format("\n{}: {} at {} along {}", what, text(c.normal), text(c.crossing.p_from), text(c.direction));
    }
};

/// The object, or a bounded part of it; nullopt if that is empty.
inline std::optional<Phased> traceable(Phased object) {
    try {
        if (!bounds(object).finite())
            object = IntersectShape{.of = object, .shape = Sphere{.radius = 1}, .phases_cut = {}};
        if (bounds(object).empty()) return std::nullopt;
        return object;
    } catch (const ModelError&) {
        return std::nullopt;
    }
}

/// Calls hit(crossing, direction) for each crossing of a ray.
template <class Hit>
void each_crossing(const InterfaceTracer& tracer, const glm::vec3& origin, const glm::vec3& direction, Hit&& hit) {
    Evaluator::Workspace& w = Evaluator::thread_workspace();
    glm::vec3 start = origin;
    Phase phase = tracer.label(origin, w);
    for (int n = 0; n < 20; ++n) {
        const auto c = tracer.first_crossing(start, direction, 0, 1e30f, phase, w);
        if (!c) return;
        hit(*c, direction);
        start = c->p_to;
        phase = c->to;
    }
}

/// Calls ray(origin, direction) for rays at an object. For each ray that hits, also calls it for some jittered rays
/// that graze the object there, a few of them within rounding errors.
template <class Ray>
void grazing_rays(const Phased& object, const InterfaceTracer& tracer, Random& rng, int count, int grazing, Ray&& ray) {
    const Bounds b = tracer.bounds();
    const float size = b.diagonal();
    Evaluator::Workspace& w = Evaluator::thread_workspace();
    for (int n = 0; n < count; ++n) {
        const glm::vec3 o = b.centre() + size * rng.uniform(0.6f, 1.5f) * rng.direction();
        const glm::vec3 d = glm::normalize(rng.in(b)-o);
        ray(o, d);
        const auto c = tracer.first_crossing(o, d, 0, 1e30f, tracer.label(o, w), w);
        if (!c) continue;
        const glm::dvec3 m = direction_of_growth(object, glm::dvec3(c->p_from), c->from,
                                                 0.01 * static_cast<double>(tracer.resolution()));
        const glm::dvec3 along = glm::cross(m, glm::dvec3(rng.direction()));
        if (!(glm::length(along) > 0)) continue;
        for (int k = 0; k < grazing; ++k) {
            const double cosine = rng.chance(0.1) ? 0.0 : static_cast<double>(std::exp2(rng.uniform(-12, -2)));
            const glm::vec3 slanted(glm::normalize(glm::normalize(along) + cosine * m));
            const glm::vec3 jitter = 3e-5f * size * rng.uniform(0, 1) * rng.direction();
            ray(c->p_from - 0.5f * size * slanted + jitter, slanted);
        }
    }
}

/// An oblique, sheared cone, and rays that graze its side where the field is zero within rounding. One in two hundred
/// gradients there is meaningless.
inline Phased leaning_cone() {
    Field cone = CappedCone{.radius_bottom = 0.5f, .radius_top = 0.25f, .height = 1};
    cone = warped(Translate{.by = {-1, -0.75f, 0}}, Field(warped(Rotate{.angle = 33}, cone)));
    cone = warped(Affine{.x = {1, 0, 0}, .y = {-0.4f, 1, 0}, .z = {0, 0.2f, -1}, .by = {0.25f, 0.5f, -0.5f}}, cone);
    return Set{.phase = Phase{1}, .of = cone};
}
template <class Ray>
void rays_at_leaning_cone(int count, Ray&& ray) {
    const glm::vec3 origin(-0.7166949665f, -0.14259064813f, -1.3098654976f);
    const glm::vec3 d = glm::normalize(glm::vec3(0.09979006958f, -0.1956524048f, 0.36351296997f));
    Random rng(73);
    for (int n = 0; n < count; ++n) ray(origin + 1e-4f * rng.direction(), d);
}

}  // namespace phasetree::tests
