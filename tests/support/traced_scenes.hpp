#pragma once

/// Scenes supported by the analytic roots, and rays through them. A third of the rays are difficult: parallel to an
/// axis, through junctions and corners, starting on interfaces, or grazing them.

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/change.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/remove.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/subtract_shape.hpp"
#include "phasetree/nodes/phased/thin_shell.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests::traced {

// Scenes.

inline Phase phase(int i) {
    return Phase{static_cast<std::uint8_t>(i)};
}
inline Phased filled(int i, Field f) {
    return Set{.phase = phase(i), .of = std::move(f)};
}
inline Field moved(const glm::vec3& by, Field f) {
    return warped(Translate{.by = by}, std::move(f));
}
template <class Handle>
Handle turned(Random& rng, Handle h) {
    return warped(Rotate{.axis = rng.direction(), .angle = rng.uniform(-180, 180)}, std::move(h));
}
inline Field random_solid(Random& rng) {
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
inline Field placed_solid(Random& rng) {
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
inline Scene junction(Random& rng, bool odd_angle) {
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
inline Scene abutting(Random& rng, bool odd_angle) {
    std::vector<Phased> boxes;
    for (int i = -2; i <= 2; ++i)
        boxes.push_back(filled(1, moved({0.3f * static_cast<float>(i), 0, 0}, Box{.size = {0.3f, 1, 0.7f}})));
    Phased a = Under{.of = boxes};
    if (odd_angle) return {"abutting, turned", turned(rng, a), {{0, 0, 0}}};
    return {"abutting", a, {{0.15f, 0.5f, 0.35f}, {-0.15f, 0, 0.35f}, {0.45f, -0.5f, 0}}};
}

/// Water in glass walls that are 10⁻⁵ of the object's size thick, an equally thin plate, and a slab.
inline Scene thin(Random& rng) {
    const Phased glass =
        ThinShell{.of = Sphere{.radius = 0.8f}, .shell = phase(1), .inside = phase(2), .half_thickness = 1e-5f};
    const Phased plate = filled(3, moved({0, 0, 1.2f}, Box{.size = {1, 1, 2.4e-5f}}));
    const Phased sheet = filled(3, turned(rng, Field(Box{.size = {2, 2.4e-5f, 2}})));
    return {"thin", Under{.of = {sheet, glass, plate}}, {{0, 0, 0.8f}, {0.5f, 0.5f, 1.2f}, {0.8f, 0, 0}}};
}

/// A vessel with a filling cut by a cone and a plane, in exact contact with the wall.
inline Scene vessel(Random& rng) {
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
inline Scene random_scene(Random& rng) {
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

inline Probe random_probe(Random& rng, const Scene& scene, const InterfaceTracer& tracer) {
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
            return {rng.chance(0.5) ? hit->p_from : hit->p_to, rng.direction(), "from an interface"};
        case 1:  // along it, a little above or below, or upon it
        {
            const float above =
                rng.chance(0.2) ? 0.f : size * std::exp2(rng.uniform(-24, -10)) * (rng.chance(0.5) ? 1.f : -1.f);
            return {hit->p_from + above * n - rng.uniform(0, 1) * size * along, along, "grazing"};
        }
        default:  // almost along it
        {
            const glm::vec3 slanted = glm::normalize(along + std::exp2(rng.uniform(-16, -3)) * n);
            return {hit->p_from - rng.uniform(0, 0.5f) * size * slanted, slanted, "slanted"};
        }
    }
}

}  // namespace phasetree::tests::traced
