// Tracing against analytic roots: no interface missed, none invented, each where it is.
//
// The scenes are CSG of spheres, boxes, cylinders, cones and planes. For a ray, in double, the roots with every
// primitive's quadrics and planes are sorted, and the midpoints between them labelled by set algebra: the exact
// sequence of phases. The tracer's sequence comes from first_crossing() again and again, each ray starting at p_out of
// the last with the phase entered.
//
// Both are step functions of t. Where they differ over a stretch of the ray, the tracer is wrong, but for two cases:
// the stretch is shorter than four resolutions, which is all that tracing promises; or it lies within one resolution of
// an interface throughout (a grazing ray, a ray within a face), where a label in float is rounding's. Rays that creep
// along an interface for hundreds of batches are traced at a coarser resolution, by the law in march.cpp, and held to
// that one; all others, and every reported crossing, to the stated one.
#include <doctest/doctest.h>

#include <cstdio>
#include <sstream>

#include "phasetree/phasetree.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra/transforms.hpp"

using namespace phasetree;
using namespace phasetree::tests;
using glm::dvec3;

namespace {

// The oracle's roots.

struct Root {
    double t;
    dvec3 normal;  ///< of the surface, in world space, either way
};

/// A ray in a node's space, and how its directions turn back to world space.
struct Ray {
    dvec3 o, d;
    dvec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< the node's axes in world space

    dvec3 at(double t) const { return o + t * d; }
    dvec3 world(const dvec3& n) const { return glm::normalize(n.x * axes[0] + n.y * axes[1] + n.z * axes[2]); }
};

using Roots = std::vector<Root>;

/// Roots of a t² + 2 b t + c, without cancellation.
template <class Use>
void solve(double a, double b, double c, Use&& use) {
    const double disc = b * b - a * c;
    if (a == 0) {
        if (b != 0) use(-c / (2 * b));
        return;
    }
    if (disc < 0) return;
    const double q = -(b + std::copysign(std::sqrt(disc), b));
    if (q != 0) use(c / q);
    use(q / a);
}
void plane_roots(const Ray& r, const dvec3& n, double offset, Roots& out) {
    const double slope = glm::dot(r.d, n);
    if (slope != 0) out.push_back({(offset - glm::dot(r.o, n)) / slope, r.world(n)});
}
void sphere_roots(const Ray& r, double radius, Roots& out) {
    solve(glm::dot(r.d, r.d), glm::dot(r.o, r.d), glm::dot(r.o, r.o) - radius * radius, [&](double t) {
        out.push_back({t, r.world(r.at(t))});
    });
}
/// ρ = a + b z: a cylinder or a cone about the z axis.
void cone_roots(const Ray& r, double a, double b, Roots& out) {
    const double k = a + b * r.o.z, l = b * r.d.z;
    solve(r.d.x * r.d.x + r.d.y * r.d.y - l * l, r.o.x * r.d.x + r.o.y * r.d.y - k * l,
          r.o.x * r.o.x + r.o.y * r.o.y - k * k, [&](double t) {
              const dvec3 p = r.at(t);
              out.push_back({t, r.world({p.x, p.y, -b * (a + b * p.z)})});
          });
}

void roots(const Field&, const Ray&, Roots&);
void roots(const Phased&, const Ray&, Roots&);

Ray through(const Translate& w, Ray r) {
    r.o = oracle::back(w, r.o);
    return r;
}
Ray through(const Rotate& w, Ray r) {
    const Rotate forth{.axis = w.axis, .angle = -w.angle};
    Ray q{oracle::back(w, r.o), oracle::back(w, r.d)};
    for (int i = 0; i < 3; ++i) {
        dvec3 e(0);
        e[i] = 1;
        const dvec3 turned = oracle::back(forth, e);
        q.axes[i] = turned.x * r.axes[0] + turned.y * r.axes[1] + turned.z * r.axes[2];
    }
    return q;
}
Ray through(const Scale& w, Ray r) {
    r.o /= static_cast<double>(w.factor);
    r.d /= static_cast<double>(w.factor);  // t stays
    return r;
}

/// Surfaces of a node's own. Nodes with children: the children's. Others are not in these scenes.
template <class Node>
void own_roots(const Node& n, const Ray& r, Roots& out) {
    if constexpr (std::is_same_v<Node, Sphere>) {
        sphere_roots(r, n.radius, out);
    } else if constexpr (std::is_same_v<Node, Plane>) {
        plane_roots(r, dvec3(n.normal), n.offset, out);
    } else if constexpr (std::is_same_v<Node, Box>) {
        for (int i = 0; i < 3; ++i) {
            dvec3 e(0);
            e[i] = 1;
            plane_roots(r, e, n.size[i] / 2.0, out);
            plane_roots(r, e, -n.size[i] / 2.0, out);
        }
    } else if constexpr (std::is_same_v<Node, Cylinder> || std::is_same_v<Node, CappedCone>) {
        double bottom, top;
        if constexpr (std::is_same_v<Node, Cylinder>)
            bottom = top = n.radius;
        else
            bottom = n.radius_bottom, top = n.radius_top;
        cone_roots(r, (bottom + top) / 2, (top - bottom) / n.height, out);
        plane_roots(r, {0, 0, 1}, n.height / 2.0, out);
        plane_roots(r, {0, 0, 1}, -n.height / 2.0, out);
    } else if constexpr (std::is_same_v<Node, ThinShell>) {
        const auto* ball = std::get_if<Sphere>(&n.of.node()->node);
        if (!ball) throw std::logic_error("the oracle knows thin shells of spheres only");
        sphere_roots(r, static_cast<double>(ball->radius) + n.half_thickness, out);
        sphere_roots(r, static_cast<double>(ball->radius) - n.half_thickness, out);
    } else if constexpr (requires { through(n.warp, r); }) {
        roots(n.of, through(n.warp, r), out);
    } else if constexpr (std::is_same_v<Node, Union> || std::is_same_v<Node, Intersection> ||
                         std::is_same_v<Node, Difference> || std::is_same_v<Node, Merge> || std::is_same_v<Node, Set> ||
                         std::is_same_v<Node, Under> || std::is_same_v<Node, Over> ||
                         std::is_same_v<Node, IntersectShape> || std::is_same_v<Node, SubtractShape> ||
                         std::is_same_v<Node, Change> || std::is_same_v<Node, Remove>) {
        for_each_child(n, [&](const auto& child) { roots(child, r, out); });
    } else {
        throw std::logic_error("the oracle has no roots for this node");
    }
}
void roots(const Field& f, const Ray& r, Roots& out) {
    std::visit([&](const auto& n) { own_roots(n, r, out); }, f.node()->node);
}
void roots(const Phased& a, const Ray& r, Roots& out) {
    std::visit([&](const auto& n) { own_roots(n, r, out); }, a.node()->node);
}

/// A phase from `start` to the next piece's start.
struct Piece {
    double start;
    Phase phase;
    dvec3 normal{0};  ///< of the surface at the start
};

std::vector<Piece> exact_pieces(const Phased& object, const dvec3& o, const dvec3& d, double length) {
    Roots all;
    roots(object, Ray{o, d}, all);
    std::erase_if(all, [&](const Root& r) { return !(r.t > 0 && r.t < length); });
    std::sort(all.begin(), all.end(), [](const Root& a, const Root& b) { return a.t < b.t; });
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i <= all.size(); ++i) {
        const double low = i == 0 ? 0 : all[i - 1].t, high = i == all.size() ? length : all[i].t;
        if (!(high > low)) continue;
        const Phase l = tests::label(object, o + 0.5 * (low + high) * d);
        if (pieces.empty() || pieces.back().phase != l)
            pieces.push_back({low, l, i == 0 ? dvec3(0) : all[i - 1].normal});
    }
    return pieces;
}

// Scenes.

Phase phase(int i) {
    return Phase{static_cast<std::uint8_t>(i)};
}
Phased filled(int i, Field f) {
    return Set{.phase = phase(i), .of = std::move(f)};
}
Field moved(const glm::vec3& by, Field f) {
    return warped(Translate{.by = by}, std::move(f));
}
template <class Handle>
Handle turned(Random& rng, Handle h) {
    return warped(Rotate{.axis = rng.direction(), .angle = rng.uniform(-180, 180)}, std::move(h));
}
Field random_solid(Random& rng) {
    const float a = rng.uniform(0.1f, 0.7f), b = rng.uniform(0.1f, 0.7f), c = rng.uniform(0.1f, 0.7f);
    switch (rng.below(4)) {
        case 0:
            return Sphere{.radius = a};
        case 1:
            return Box{.size = {2 * a, 2 * b, 2 * c}};
        case 2:
            return Cylinder{.radius = a, .height = 2 * b};
        default:
            return CappedCone{.radius_bottom = a, .radius_top = b, .height = 2 * c};
    }
}
Field placed_solid(Random& rng) {
    Field f = random_solid(rng);
    if (rng.chance(0.5)) f = turned(rng, f);
    return moved(rng.in(Bounds::centred(glm::vec3(0.8f))), f);
}

struct Scene {
    const char* name;
    Phased object;
    std::vector<glm::vec3> corners;  ///< of edges and junctions, where rays are aimed
};

/// Eight cubes of three phases and vacuum about the origin: edges and a corner where four phases meet.
Scene junction(Random& rng, bool odd_angle) {
    std::vector<Phased> cubes;
    for (int i = 0; i < 8; ++i) {
        const int p = (i * 3 + i / 4) % 4;
        if (p == 0) continue;
        cubes.push_back(filled(p, moved({(i & 1) ? 0.5f : -0.5f, (i & 2) ? 0.5f : -0.5f, (i & 4) ? 0.5f : -0.5f},
                                        Box{.size = {1, 1, 1}})));
    }
    Phased a = Under{.of = cubes};
    if (odd_angle) return {"junction, turned", turned(rng, a), {{0, 0, 0}}};
    return {
        "junction", a, {{0, 0, 0}, {0.3f, 0, 0}, {1, 1, 1}, {0, 1, 0.5f}, {0, 1, 1}, {-1, -1, 1}, {0.25f, 0.25f, 0}}};
}

/// Boxes of one phase side by side, with faces in common.
Scene abutting(Random& rng, bool odd_angle) {
    std::vector<Phased> boxes;
    for (int i = -2; i <= 2; ++i)
        boxes.push_back(filled(1, moved({0.3f * static_cast<float>(i), 0, 0}, Box{.size = {0.3f, 1, 0.7f}})));
    Phased a = Under{.of = boxes};
    if (odd_angle) return {"abutting, turned", turned(rng, a), {{0, 0, 0}}};
    return {"abutting", a, {{0.15f, 0.5f, 0.35f}, {-0.15f, 0, 0.35f}, {0.45f, -0.5f, 0}}};
}

/// Glass walls of 10⁻⁵ of the object about water, a plate as thin, a slab.
Scene thin(Random& rng) {
    const Phased glass =
        ThinShell{.of = Sphere{.radius = 0.8f}, .shell = phase(1), .inside = phase(2), .half_thickness = 1e-5f};
    const Phased plate = filled(3, moved({0, 0, 1.2f}, Box{.size = {1, 1, 2.4e-5f}}));
    const Phased sheet = filled(3, turned(rng, Field(Box{.size = {2, 2.4e-5f, 2}})));
    return {"thin", Under{.of = {sheet, glass, plate}}, {{0, 0, 0.8f}, {0.5f, 0.5f, 1.2f}, {0.8f, 0, 0}}};
}

/// A vessel with a filling cut by a cone and a plane, in exact contact with the wall.
Scene vessel(Random& rng) {
    const Phased shell =
        ThinShell{.of = Sphere{.radius = 0.9f}, .shell = phase(1), .inside = phase(2), .half_thickness = 0.03f};
    const Field heap = Intersection{.of = {Plane{.normal = {0.1f, 0, 1}, .offset = -0.1f},
                                           CappedCone{.radius_bottom = 1.2f, .radius_top = 0, .height = 1.5f}}};
    const Phased sand = IntersectShape{.of = shell, .shape = heap, .phases_cut = PhaseSet::of(phase(2))};
    const Phased foot = filled(3, moved({0, 0, -0.97f}, Cylinder{.radius = 0.7f, .height = 0.2f}));
    const Phased a =
        Over{.of = {sand, foot, filled(4, moved({0.95f, 0, 0}, turned(rng, Field(Box{.size = {0.1f, 0.1f, 2}}))))}};
    return {"vessel", a, {{0.7f, 0, -0.97f}, {0, 0, 0.2f}, {0, 0.7f, -0.87f}}};
}

/// Random solids in four phases, replaced, cut and changed.
Scene random_scene(Random& rng) {
    std::vector<Phased> solids;
    const int n = 2 + rng.below(6);
    for (int i = 0; i < n; ++i) {
        Field f = placed_solid(rng);
        if (rng.chance(0.3)) f = Difference{.from = f, .subtract = {placed_solid(rng)}};
        if (rng.chance(0.2)) f = Intersection{.of = {f, placed_solid(rng)}};
        solids.push_back(filled(1 + rng.below(4), f));
    }
    Phased a = Under{.of = solids};
    if (rng.chance(0.5)) a = Change{.of = a, .from = phase(1), .to = phase(2), .shape = placed_solid(rng)};
    if (rng.chance(0.5))
        a = SubtractShape{
            .of = a, .shape = Plane{.normal = rng.direction(), .offset = rng.uniform(-0.3f, 0.3f)}, .phases_cut = {}};
    if (rng.chance(0.5)) a = SubtractShape{.of = a, .shape = placed_solid(rng), .phases_cut = PhaseSet::of(phase(3))};
    if (rng.chance(0.2)) a = Remove{.of = a, .gone = PhaseSet::of(phase(4))};
    if (rng.chance(0.3)) a = warped(Scale{.factor = std::exp(rng.uniform(-4, 4))}, a);
    if (rng.chance(0.2)) a = warped(Translate{.by = rng.uniform(1, 30) * rng.direction()}, a);
    return {"random", a, {}};
}

// Rays.

struct Probe {
    glm::vec3 o, d;
    const char* kind;
};

Probe random_probe(Random& rng, const Scene& scene, const InterfaceTracer& tracer) {
    const Bounds b = tracer.bounds();
    const float size = b.diagonal();
    glm::vec3 o = b.centre() + size * rng.uniform(0.6f, 1.5f) * rng.direction();
    const glm::vec3 target = rng.in(b);
    if (rng.chance(0.3)) o = rng.in(b);
    glm::vec3 d = glm::normalize(target - o);
    if (!rng.chance(1.0 / 3)) return {o, d, "plain"};
    Evaluator::Workspace w;
    switch (rng.below(6)) {
        case 0:  // parallel to an axis
            d = glm::vec3(0);
            d[rng.below(3)] = rng.chance(0.5) ? 1.f : -1.f;
            return {rng.in(b)-d * size, d, "axis-parallel"};
        case 1: {  // through an edge, a corner, a junction, or along a face that ends there
            if (scene.corners.empty()) return {o, d, "plain"};
            const glm::vec3 c =
                scene.corners[static_cast<std::size_t>(rng.below(static_cast<int>(scene.corners.size())))];
            if (rng.chance(0.5)) {
                d = glm::normalize(c - o);
            } else {
                d = glm::vec3(0);
                d[rng.below(3)] = rng.chance(0.5) ? 1.f : -1.f;
                if (rng.chance(0.3)) d[rng.below(3)] += 1;
                if (glm::length(d) == 0) d.x = 1;
                d = glm::normalize(d);
            }
            return {c - rng.uniform(0.5f, 2) * d, d, "corner"};
        }
        default:
            break;
    }
    // The others start from a point of an interface, found along the plain ray.
    const auto hit = tracer.first_crossing(o, d, 0, 1e30f, {}, w);
    if (!hit) return {o, d, "plain"};
    const glm::vec3 n = tracer.normal(*hit, d);
    glm::vec3 along = glm::cross(n, rng.direction());
    if (glm::length(along) == 0) return {o, d, "plain"};
    along = glm::normalize(along);
    switch (rng.below(3)) {
        case 0:  // starting on an interface
            return {rng.chance(0.5) ? hit->p_in : hit->p_out, rng.direction(), "from an interface"};
        case 1:  // along it, a little above or below, or upon it
        {
            const float above =
                rng.chance(0.2) ? 0.f : size * std::exp2(rng.uniform(-24, -10)) * (rng.chance(0.5) ? 1.f : -1.f);
            return {hit->p_in + above * n - rng.uniform(0, 1) * size * along, along, "grazing"};
        }
        default:  // almost along it
        {
            const glm::vec3 slanted = glm::normalize(along + std::exp2(rng.uniform(-16, -3)) * n);
            return {hit->p_in - rng.uniform(0, 0.5f) * size * slanted, slanted, "slanted"};
        }
    }
}

// The comparison.

struct Totals {
    std::size_t rays = 0, crossings = 0, wrong = 0, uncertified = 0, wide = 0, over_sliver = 0, misplaced = 0,
                bad_normals = 0;
    std::size_t passed_coarsely = 0, most_crossings = 0, flickering = 0;
    std::size_t normals = 0, reflections = 0, self_hits = 0, coarsened = 0;
};

struct Step {
    double t_in, t_out;
    Crossing crossing;
};

std::string report(const char* what, const Scene& scene, const Probe& probe, int n) {
    std::ostringstream s;
    s.precision(9);
    s << what << ": scene " << scene.name << ", ray " << n << " (" << probe.kind << ") o = (" << probe.o.x << ", "
      << probe.o.y << ", " << probe.o.z << ") d = (" << probe.d.x << ", " << probe.d.y << ", " << probe.d.z << ")";
    return s.str();
}

/// Whether an interface in the plane with this normal passes here without an edge near; nor a seam, where solids of one
/// phase meet beneath the surface: there the nearest zero of φ is the seam's.
bool is_smooth(const Phased& object, const dvec3& p, const dvec3& n, Phase from, Phase to, double resolution) {
    const dvec3 u = glm::normalize(std::abs(n.x) < 0.5 ? glm::cross(n, dvec3(1, 0, 0)) : glm::cross(n, dvec3(0, 1, 0)));
    const dvec3 v = glm::cross(n, u);
    for (const double side : {-4 * resolution, 4 * resolution})
        if (values(object, p + side * n).interface_distance() < 3 * resolution) return false;
    for (int i = 0; i < 8; ++i) {
        const dvec3 q = p + 40 * resolution * (std::cos(i * 0.7853981634) * u + std::sin(i * 0.7853981634) * v);
        if (tests::label(object, q - 4 * resolution * n) != from || tests::label(object, q + 4 * resolution * n) != to)
            return false;
    }
    return true;
}

void check_ray(const Scene& scene, const InterfaceTracer& tracer, const Probe& probe, int number,
               Evaluator::Workspace& w, Totals& totals, std::vector<std::string>& complaints) {
    const double resolution = tracer.resolution();
    const dvec3 o(probe.o), d(probe.d);
    const float length = 4 * tracer.bounds().diagonal();
    const auto complain = [&](const char* what) {
        if (complaints.size() < 10) complaints.push_back(report(what, scene, probe, number));
    };

    // The tracer's sequence.
    std::vector<Step> steps;
    const Phase first = tracer.label(probe.o, w);
    Phase carried = first;
    glm::vec3 origin = probe.o;
    ++totals.rays;
    // Tracing keeps the work of a creeping ray bounded: from 128 batches on the resolution doubles every 32.
    bool coarse = false;
    double effective = resolution;
    for (int n = 0; n < 20'000; ++n) {
        TraceCounters counters;
        const auto hit = tracer.first_crossing(origin, probe.d, 0, length, carried, w, &counters);
        if (counters.batches > 128) {
            coarse = true;
            effective =
                std::max(effective, std::ldexp(resolution, static_cast<int>((counters.batches - 128) / 32 + 1)));
        }
        if (!hit) break;
        steps.push_back({glm::dot(dvec3(hit->p_in) - o, d), glm::dot(dvec3(hit->p_out) - o, d), *hit});
        ++totals.crossings;
        const bool certified = hit->from == carried && hit->from != hit->to && tracer.label(hit->p_out, w) == hit->to &&
                               (tracer.label(hit->p_in, w) == hit->from || (hit->t_in == 0 && hit->t_out == 0));
        if (!certified && totals.uncertified++ < 3) complain("not certified");
        const double width = glm::length(dvec3(hit->p_out) - dvec3(hit->p_in));
        // The bracket is cut down to a resolution, and its ends are rounded to float coordinates. One that passes a
        // sliver of a third phase, undecided for up to 1.5 resolutions, is that much longer.
        totals.over_sliver += width > 1.01 * resolution + 1e-6 * glm::length(dvec3(hit->p_in));
        if (width > 2.7 * resolution + 1e-6 * glm::length(dvec3(hit->p_in)) && totals.wide++ < 3)
            complain("wide bracket");
        carried = hit->to;
        origin = hit->p_out;
    }
    totals.coarsened += coarse;
    totals.most_crossings = std::max(totals.most_crossings, steps.size());
    totals.flickering += steps.size() > 100;

    // Where the two step functions differ.
    const std::vector<Piece> exact = exact_pieces(scene.object, o, d, length);
    std::vector<double> breaks{0, length};
    for (const Piece& p : exact) breaks.push_back(p.start);
    for (const Step& s : steps) breaks.push_back(0.5 * (s.t_in + s.t_out));
    std::sort(breaks.begin(), breaks.end());
    const auto exact_label = [&](double t) {
        std::size_t i = 0;
        while (i + 1 < exact.size() && exact[i + 1].start <= t) ++i;
        return exact[i].phase;
    };
    const auto traced_label = [&](double t) {
        Phase l = first;
        for (const Step& s : steps)
            if (0.5 * (s.t_in + s.t_out) <= t) l = s.crossing.to;
        return l;
    };
    double wrong_since = -1;
    bool passed = false;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double low = std::max(breaks[i], 0.0), high = breaks[i + 1];
        if (!(high > low)) continue;
        const double mid = 0.5 * (low + high);
        const bool wrong = exact_label(mid) != traced_label(mid);
        if (wrong && wrong_since < 0) wrong_since = low;
        const bool ends = wrong_since >= 0 && (!wrong || i + 2 == breaks.size());
        if (!ends) continue;
        const double begin = wrong_since, end = wrong ? high : low;
        wrong_since = -1;
        if (end - begin <= 4 * resolution) continue;
        double deepest = 0;
        for (int k = 0; k <= 64; ++k)
            deepest =
                std::max(deepest, values(scene.object, o + (begin + (end - begin) * k / 64) * d).interface_distance());
        if (deepest <= resolution) continue;
        if (end - begin <= 4 * effective) {
            passed = true;
            continue;
        }
        if (totals.wrong++ < 3) {
            std::ostringstream what;
            what.precision(9);
            what << "wrong from t = " << begin << " to " << end << " (" << (end - begin) / resolution
                 << " resolutions, " << deepest / resolution << " deep" << (coarse ? ", coarsened" : "")
                 << "), exact phase " << int(exact_label(0.5 * (begin + end)).index) << ", traced "
                 << int(traced_label(0.5 * (begin + end)).index);
            complain(what.str().c_str());
        }
    }

    totals.passed_coarsely += passed;

    // Isolated crossings: where they are, their normals, and what is reflected there.
    for (std::size_t i = 1; i + 1 <= exact.size(); ++i) {
        const double t = exact[i].start, last = i + 1 < exact.size() ? exact[i + 1].start : length;
        if (t - exact[i - 1].start < 100 * resolution || last - t < 100 * resolution) continue;
        dvec3 n = exact[i].normal;
        double cosine = glm::dot(n, d);
        if (cosine < 0) n = -n, cosine = -cosine;
        if (cosine < 0.02) continue;
        if (!is_smooth(scene.object, o + t * d, n, exact[i - 1].phase, exact[i].phase, resolution)) continue;
        const Step* nearest = nullptr;
        for (const Step& s : steps)
            if (!nearest || std::abs(s.t_out - t) < std::abs(nearest->t_out - t)) nearest = &s;
        // The field's own rounding, below half a resolution, moves the interface along a slanted ray.
        const double tolerance = 0.5 * resolution / cosine;
        if (!nearest || nearest->t_in > t + tolerance || nearest->t_out < t - tolerance) {
            if (totals.misplaced++ < 3) complain("misplaced");
            continue;
        }
        const Crossing& hit = nearest->crossing;
        const glm::vec3 normal = tracer.normal(hit, probe.d);
        ++totals.normals;
        if (glm::length(glm::cross(dvec3(normal), n)) > 1e-3 || glm::dot(dvec3(normal), n) < 0) {
            if (totals.bad_normals++ < 3) complain("normal");
        }
        const glm::vec3 back = glm::normalize(probe.d - 2 * glm::dot(probe.d, normal) * normal);
        const auto again = tracer.first_crossing(hit.p_in, back, 0, length, hit.from, w);
        ++totals.reflections;
        if (again && again->t_out < tracer.resolution()) {
            if (totals.self_hits++ < 3) complain("a reflected ray hits where it starts");
        }
    }
}

void trace_scenes(std::uint64_t seed, int scenes, int rays_each, Totals& totals, std::vector<std::string>& complaints) {
    Random rng(seed);
    Evaluator::Workspace w;
    for (int n = 0; n < scenes; ++n) {
        Scene scene;
        switch (n % 10) {
            case 0:
                scene = junction(rng, false);
                break;
            case 1:
                scene = junction(rng, true);
                break;
            case 2:
                scene = abutting(rng, false);
                break;
            case 3:
                scene = abutting(rng, true);
                break;
            case 4:
                scene = thin(rng);
                break;
            case 5:
                scene = vessel(rng);
                break;
            default:
                scene = random_scene(rng);
        }
        std::optional<InterfaceTracer> tracer;
        try {
            tracer.emplace(scene.object);
        } catch (const ModelError&) {
            continue;  // cut to nothing
        }
        for (int ray = 0; ray < rays_each; ++ray)
            check_ray(scene, *tracer, random_probe(rng, scene, *tracer), ray, w, totals, complaints);
    }
}

}  // namespace

TEST_CASE("every interface along a ray is found, once, where it is") {
    Totals totals;
    std::vector<std::string> complaints;
    trace_scenes(91, long_tests() ? 4000 : 200, 250, totals, complaints);
    for (const std::string& c : complaints) MESSAGE(c);
    MESSAGE(totals.rays, " rays, ", totals.crossings, " crossings, ", totals.normals, " normals, ", totals.reflections,
            " reflections, ", totals.coarsened, " rays creep, of which ", totals.passed_coarsely, " passed something; ",
            totals.flickering, " rays within rounding of a face cross it more than 100 times, at most ",
            totals.most_crossings);
    CHECK(totals.wrong == 0);
    CHECK(totals.flickering < totals.rays / 2000);
    CHECK(totals.passed_coarsely < totals.rays / 50);
    CHECK(totals.uncertified == 0);
    CHECK(totals.wide == 0);
    CHECK(totals.over_sliver < totals.crossings / 2000);
    CHECK(totals.misplaced == 0);
    CHECK(totals.bad_normals == 0);
    CHECK(totals.self_hits == 0);
    CHECK(totals.crossings > totals.rays);
    CHECK(totals.normals > totals.rays / 2);
}
