#pragma once

/// Rays that creep along faces, edges, seams and straight lines of solids of every kind, with balls and thin shells in
/// their way, most of them behind the point where the ray leaves the solid. The crossings of balls are known from their
/// roots, and none may be missed, however long the ray has crept before.
///
/// Lines in surfaces are found with the oracle's distances, in double. At a point of the surface, candidates are the
/// directions in which the distance nearby changes sign or is smallest; the direction that stays on the surface longest
/// is chosen. If the surface is flat at two points, the line is the common edge of their planes.

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/change.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/stretch.hpp"
#include "phasetree/nodes/warps/taper.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/analytic_roots.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace phasetree::tests::creeping {

using glm::dvec3;

/// A straight line that stays on a surface.
struct Line {
    dvec3 at, along;
    double length = 0;  ///< about how far, both ways
};

/// A ball or a spherical shell, in the solid's phase 1 or in another.
struct Target {
    glm::vec3 centre{0};
    float radius = 0, half_thickness = 0;  ///< of a shell's wall; 0: a ball
    Phase phase{1};

    Field field() const {
        const Field ball = Sphere{.radius = radius};
        const Field shape = half_thickness > 0 ? Field(Shell{.of = ball, .half_thickness = half_thickness}) : ball;
        return warped(Translate{.by = centre}, shape);
    }
};

struct Scene {
    std::string kind;
    Phased object;
    glm::vec3 o{0}, d{0};
    double crept = 0;  ///< how far the ray keeps to the surface
    std::vector<Target> targets;
};

struct Totals {
    std::size_t rays = 0, lines = 0, roots = 0, missed = 0, flickering = 0, uncertified = 0;
    std::uint64_t batches = 0, max_batches = 0;
    double most_crept = 0;  ///< in resolutions
    std::vector<std::string> complaints;
};

/// The distance from a point along a direction for which a field stays within `near` of zero, at most `far`.
inline double kept_to(const Field& f, const dvec3& p, const dvec3& d, double near, double far) {
    double reached = 0;
    for (double step = far / 1024; step <= far; step *= 2)
        for (const double share : {0.55, 0.7, 0.85, 1.0}) {
            if (!(std::abs(value(f, p + share * step * d)) <= near)) return reached;
            reached = share * step;
        }
    return reached;
}
inline Line measured(const Field& f, const dvec3& p, const dvec3& d, double near, double far) {
    return {p, d, kept_to(f, p, d, near, far) + kept_to(f, p, -d, near, far)};
}

/// The direction in the surface at p that stays on it longest.
inline Line line_through(const Field& f, const dvec3& p, const dvec3& normal, double near, double size) {
    const dvec3 u = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 v = glm::cross(normal, u);
    const double reach = 0.03 * size;
    constexpr int count = 24;
    const auto direction = [&](double turn) {
        const double angle = turn * (3.14159265358979323846 / count);
        return std::cos(angle) * u + std::sin(angle) * v;
    };
    const auto off = [&](double turn) { return value(f, p + reach * direction(turn)); };
    std::vector<double> turns;
    double before = off(0), smallest = 1e30, best = 0;
    for (int i = 0; i < 2 * count; ++i) {
        const double after = off(i + 1);
        if (std::abs(after) < smallest) smallest = std::abs(after), best = i + 1;
        if ((before < 0) != (after < 0)) {
            double low = i, high = i + 1;
            for (int k = 0; k < 40; ++k) {
                const double middle = 0.5 * (low + high);
                ((off(middle) < 0) == (before < 0) ? low : high) = middle;
            }
            turns.push_back(low);
        }
        before = after;
    }
    // Where the field only touches zero: the minimum of its magnitude (golden section).
    double low = best - 1, high = best + 1;
    for (int k = 0; k < 40; ++k) {
        const double a = low + 0.381966 * (high - low), b = high - 0.381966 * (high - low);
        (std::abs(off(a)) < std::abs(off(b)) ? high : low) = std::abs(off(a)) < std::abs(off(b)) ? b : a;
    }
    turns.push_back(0.5 * (low + high));
    Line line{p, u, 0};
    for (const double turn : turns) {
        const Line other = measured(f, p, direction(turn), near, size);
        if (other.length > line.length) line = other;
    }
    return line;
}

/// The intersection line of the tangent planes at two points of a surface, through its point nearest to their middle.
inline Line edge_between(const Field& f, const dvec3& p, const dvec3& m, const dvec3& q, const dvec3& n, double near,
                         double size) {
    const dvec3 along = glm::cross(m, n);
    const double sine = glm::dot(along, along);
    if (!(sine > 0.01)) return {};
    const dvec3 middle = 0.5 * (p + q);
    const double a = glm::dot(m, p - middle), b = glm::dot(n, q - middle);
    const dvec3 at = middle + (a * glm::cross(n, along) + b * glm::cross(along, m)) / sine;
    if (!(std::abs(value(f, at)) <= near)) return {};
    return measured(f, at, along / std::sqrt(sine), near, size);
}

struct OnSurface {
    dvec3 at, normal;
};
inline std::optional<OnSurface> on_surface(Random& rng, const InterfaceTracer& tracer) {
    const Bounds b = tracer.bounds();
    Evaluator::Workspace w;
    for (int tries = 0; tries < 8; ++tries) {
        const glm::vec3 from = b.centre() + b.diagonal() * rng.direction();
        glm::vec3 d = glm::normalize(rng.in(b)-from);
        glm::vec3 o = from;
        if (rng.chance(0.3)) {  // round coordinates: faces of copies and cells, symmetry
            d = glm::vec3(0);
            d[rng.below(3)] = 1;
            o = glm::round(rng.in(b)*8.f) / 8.f - d * b.diagonal();
        }
        if (const auto hit = tracer.first_crossing(o, d, 0, 1e30f, {}, w))
            return OnSurface{dvec3(hit->p_from), dvec3(tracer.normal(*hit, d))};
    }
    return std::nullopt;
}

/// The longest of several lines in a solid's surface.
inline std::optional<Line> random_line(Random& rng, const Field& f) {
    const InterfaceTracer tracer(Set{.phase = Phase{1}, .of = f});
    const double size = static_cast<double>(tracer.bounds().diagonal());
    const double near = 0.4 * static_cast<double>(tracer.resolution());
    const bool is_edge = rng.chance(0.4);
    Line line;
    for (int tries = 0; tries < (is_edge ? 6 : 2); ++tries) {
        auto a = on_surface(rng, tracer);
        if (!a) return std::nullopt;
        // Moves a point that is within a resolution of the surface onto it.
        const double off = value(f, a->at);
        a->at -= off * a->normal;
        if (std::abs(value(f, a->at)) > near) a->at += 2 * off * a->normal;
        Line other;
        if (is_edge) {
            if (const auto b = on_surface(rng, tracer))
                other = edge_between(f, a->at, a->normal, b->at, b->normal, near, size);
        } else {
            other = line_through(f, a->at, a->normal, near, size);
        }
        if (other.length > line.length) line = other;
    }
    return line.length > 0 ? std::optional(line) : std::nullopt;
}

/// A ray along a line of the solid, and its targets, behind the line or on it.
inline std::optional<Scene> scene_along(Random& rng, std::string kind, const Field& solid) {
    const std::optional<Line> line = random_line(rng, solid);
    if (!line) return std::nullopt;
    const Bounds b = bounds(solid);
    const double size = static_cast<double>(b.diagonal());
    Scene scene{.kind = std::move(kind), .object = Set{.phase = Phase{1}, .of = solid}, .targets = {}};
    const dvec3 along = rng.chance(0.5) ? line->along : -line->along;
    scene.d = glm::vec3(along);
    if (rng.chance(0.5)) scene.d = glm::vec3(glm::normalize(along));
    dvec3 at = line->at;
    // Within rounding of it, above or below.
    if (rng.chance(0.5)) at += 1e-6 * size * std::exp2(-rng.unit() * 8) * dvec3(rng.direction());
    const double back = rng.chance(0.2) ? 0.1 * rng.unit() : rng.unit() + 0.5;
    scene.o = glm::vec3(at - back * size * along);
    scene.crept = line->length;
    // Behind the line, where there is room; some on the line itself.
    std::vector<Field> same{solid};
    std::vector<Phased> others;
    const int count = 1 + rng.below(3);
    for (int n = 0; n < count; ++n) {
        Target t;
        const bool is_on_line = rng.chance(0.2);
        t.radius = static_cast<float>(size) * std::exp2(-rng.uniform(3, 13));
        const double far = (is_on_line ? 0.3 * (2 * rng.unit() - 1) : rng.unit() * 1.2) * size;
        const dvec3 aside = 0.9 * rng.unit() * static_cast<double>(t.radius) * dvec3(rng.direction());
        t.centre = glm::vec3(dvec3(scene.o) + (back * size + far) * dvec3(scene.d) + aside);
        t.phase = Phase{static_cast<std::uint8_t>(is_on_line || rng.chance(0.5) ? 2 : 1)};
        if (rng.chance(0.5)) t.half_thickness = t.radius * 0.5f * std::exp2(-rng.uniform(0, 8));
        if (static_cast<double>(t.half_thickness) * 2 < 3e-5 * size) t.half_thickness = 0;
        // A target in the solid's own phase is placed where the oracle says that there is room.
        const double reach = 1.05 * static_cast<double>(t.radius + t.half_thickness) + 1e-4 * size;
        const dvec3 centre(t.centre);
        if (t.phase == Phase{1} && !(value(solid, centre) > reach)) continue;
        if (std::ranges::any_of(scene.targets, [&](const Target& other) {
                return glm::length(dvec3(other.centre) - centre) <
                       reach + 1.05 * static_cast<double>(other.radius + other.half_thickness);
            }))
            continue;
        scene.targets.push_back(t);
        if (t.phase == Phase{1})
            same.push_back(t.field());
        else
            others.push_back(Set{.phase = t.phase, .of = t.field()});
    }
    if (scene.targets.empty()) return std::nullopt;
    // A later object replaces the earlier.
    others.insert(others.begin(), Set{.phase = Phase{1}, .of = same.size() > 1 ? Field(Union{.of = same}) : solid});
    scene.object = Under{.of = others};
    return scene;
}

/// The distances at which a ray enters and leaves a target's substance.
struct Chord {
    double enters, leaves;
    double enters_at, leaves_at;  ///< the cosine there
    Phase phase;
};
inline std::vector<Chord> chords(const Scene& scene) {
    std::vector<Chord> all;
    const dvec3 d(scene.d);
    for (const Target& t : scene.targets) {
        const dvec3 o = dvec3(scene.o) - dvec3(t.centre);
        const auto ball = [&](double radius) {
            std::vector<double> roots;
            analytic::solve(glm::dot(d, d), glm::dot(o, d), glm::dot(o, o) - radius * radius,
                            [&](double root) { roots.push_back(root); });
            std::ranges::sort(roots);
            return roots;
        };
        const auto cosine = [&](double root) {
            return std::abs(glm::dot(glm::normalize(o + root * d), glm::normalize(d)));
        };
        const double r = t.radius, h = t.half_thickness;
        const std::vector<double> outer = ball(r + h), inner = h > 0 ? ball(r - h) : std::vector<double>();
        if (outer.size() < 2) continue;
        const auto add = [&](double from, double to) {
            if (to > 0) all.push_back({from, to, cosine(from), cosine(to), t.phase});
        };
        if (inner.size() < 2) {
            add(outer[0], outer[1]);
        } else {
            add(outer[0], inner[0]);
            add(inner[1], outer[1]);
        }
    }
    std::ranges::sort(all, {}, &Chord::enters);
    return all;
}

/// `tracer` as crossing_checks.hpp has it.
template <class Tracer>
void check(const Scene& scene, const Tracer& tracer, Totals& totals) {
    using Hit = typename Tracer::Hit;
    const double resolution = tracer.resolution();
    const dvec3 o(scene.o), d(scene.d);
    const float length = 4 * tracer.bounds().diagonal();
    ++totals.rays;
    totals.lines += scene.crept > 2000 * resolution;
    totals.most_crept = std::max(totals.most_crept, scene.crept / resolution);
    const auto complain = [&](const std::string& what) {
        if (totals.complaints.size() >= 10) return;
        std::ostringstream s;
        s.precision(9);
        s << scene.kind << ": " << what << ", crept " << scene.crept / resolution << " resolutions, o = (" << scene.o.x
          << ", " << scene.o.y << ", " << scene.o.z << ") d = (" << scene.d.x << ", " << scene.d.y << ", " << scene.d.z
          << ")";
        totals.complaints.push_back(s.str());
    };
    struct Change {
        double in, out;
        Phase from, to;
    };
    std::vector<Change> changes;
    glm::vec3 origin = scene.o;
    Phase carried = tracer.label(origin);
    std::optional<Hit> last;
    double aside = 0;
    bool is_flickering = false;
    for (int n = 0; !is_flickering; ++n) {
        TraceCounters counters;
        const auto hit = tracer.first_crossing(origin, scene.d, length, carried, last ? &*last : nullptr, counters);
        totals.batches += counters.batches;
        totals.max_batches = std::max(totals.max_batches, counters.batches);
        if (!hit) break;
        changes.push_back({glm::dot(dvec3(hit->p_from) - o, d), glm::dot(dvec3(hit->p_to) - o, d), hit->from, hit->to});
        if (hit->from != carried || tracer.label(hit->p_to) != hit->to) ++totals.uncertified;
        carried = hit->to;
        origin = hit->p_to;
        last = hit;
        aside = std::max(aside, glm::length(glm::cross(dvec3(origin) - o, d)));
        is_flickering = n > 300;
    }
    totals.flickering += is_flickering;
    const double end = is_flickering ? changes.back().in : 1e30;
    // A root is found if the phase changes there as expected. A ray that was displaced by rounding, or that grazes, may
    // find it correspondingly earlier or later.
    for (const Chord& s : chords(scene)) {
        if (s.enters < 4 * resolution || s.leaves - s.enters < 4 * resolution || s.leaves > end) continue;
        const auto found = [&](double root, double cosine, auto&& is_meant) {
            const double tolerance = 2 * resolution + 2e-7 * std::abs(root) + (0.5 * resolution + aside) / cosine;
            return std::ranges::any_of(changes, [&](const Change& c) {
                return is_meant(c) && c.in <= root + tolerance && c.out >= root - tolerance;
            });
        };
        if (s.enters_at < 0.05 || s.leaves_at < 0.05) continue;
        totals.roots += 2;
        // What touches a ball on the line may already be in its phase.
        const bool enters = found(s.enters, s.enters_at, [&](const Change& c) { return c.to == s.phase; });
        const bool leaves = found(s.leaves, s.leaves_at, [&](const Change& c) { return c.from == s.phase; });
        totals.missed += !enters + !leaves;
        if (!enters || !leaves) {
            std::ostringstream s2;
            s2.precision(9);
            s2 << "phase " << int(s.phase.index) << " from " << s.enters << " to " << s.leaves << " is missed ("
               << (s.leaves - s.enters) / resolution << " resolutions)" << (enters ? ", its end" : "")
               << (leaves ? ", its begin" : "") << ", aside " << aside / resolution;
            complain(s2.str());
        }
    }
}

/// A solid of every kind of field, and combinations of two: one above the other, intersected or subtracted. Some are
/// warped, rotated, or moved by round numbers.
inline Field random_solid(Random& rng, const NodeKind& kind) {
    const auto placed = [&](Field f) {
        if (!bounds(f).finite()) f = Intersection{.of = {f, Box{.size = glm::vec3(2)}}};
        const float which = rng.uniform(0, 1);
        if (which < 0.1f) f = warped(Twist{.rate = rng.uniform(20, 200)}, f);
        if (which > 0.1f && which < 0.15f) f = warped(Stretch{.factors = {1, 0.5f, 2}}, f);
        if (which > 0.15f && which < 0.2f) f = warped(Taper{}, f);
        if (rng.chance(0.5)) f = warped(Rotate{.axis = rng.direction(), .angle = rng.uniform(-180, 180)}, f);
        if (rng.chance(0.5)) f = warped(Translate{.by = 0.125f * glm::round(4.f * rng.direction())}, f);
        return f;
    };
    Field f = placed(kind.field(rng, 1 + rng.below(2)));
    if (rng.chance(0.5)) {
        const Field other = placed(random_field(rng, 1));
        switch (rng.below(4)) {
            case 0:
                f = Difference{.from = f, .subtract = {other}};
                break;
            case 1:
                f = Intersection{.of = {f, other}};
                break;
            default:
                f = Union{.of = {f, other}};
        }
    }
    return f;
}

/// `make(object)` returns a tracer.
template <class Make>
void trace_along_lines(std::uint64_t seed, int rounds, Make&& make, Totals& totals) {
    Random rng(seed);
    for (int round = 0; round < rounds; ++round)
        for (const NodeKind& kind : node_kinds()) {
            if (!kind.is_field) continue;
            try {
                const Field solid = random_solid(rng, kind);
                for (int n = 0; n < 3; ++n)
                    if (const auto scene = scene_along(rng, std::string(kind.name), solid))
                        check(*scene, make(scene->object), totals);
            } catch (const ModelError&) {
                continue;  // cut to nothing
            }
        }
}

inline void check_totals(const Totals& totals) {
    for (const std::string& c : totals.complaints) MESSAGE(c);
    MESSAGE(totals.rays, " rays, of which ", totals.lines, " creep for more than 2,000 resolutions, at most for ",
            totals.most_crept, "; ", totals.roots, " roots, ", totals.missed, " missed; ", totals.batches / totals.rays,
            " batches a ray, at most ", totals.max_batches, "; ", totals.flickering, " rays flicker");
    CHECK(totals.missed == 0);
    CHECK(totals.flickering < totals.rays / 20);
    CHECK(totals.lines > totals.rays / 4);
    CHECK(totals.roots > totals.rays / 2);
}

}  // namespace phasetree::tests::creeping
