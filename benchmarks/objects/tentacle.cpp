#include "objects/tentacle.hpp"

#include <cmath>
#include <numbers>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/instances.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/round_cone.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/layered_sequence.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/subtract_shape.hpp"
#include "phasetree/nodes/phased/under.hpp"

namespace phasetree::bench {

namespace {

constexpr Phase core{1}, muscle{2}, skin{3}, bump{4};
constexpr float muscle_thickness = 0.06f, skin_thickness = 0.03f;
constexpr double covered = 0.22;  // share of the skin under bumps
constexpr int steps = 2048;       // of the curve

// The arm's centre line with a frame across it and the skin's radius, at equal steps of arc length.
struct Station {
    glm::dvec3 at, along, side, up;
    double radius;
};

std::vector<Station> centre_line() {
    constexpr double length = 7.5;
    std::vector<Station> line;
    glm::dvec3 p(0);
    for (int i = 0; i <= steps; ++i) {
        const double u = static_cast<double>(i) / steps;
        // It leans over more and more, and leaves its plane a little.
        const double lean = 0.25 + 3.9 * u * u, turn = 0.7 * u;
        const glm::dvec3 along(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), std::cos(lean));
        const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(0.1, 1, 0)));
        line.push_back({p, along, side, glm::cross(side, along), 0.8 * (1 - u) + 0.12});
        p += along * (length / steps);
    }
    return line;
}

Field core_of(const std::vector<Station>& line) {
    constexpr int cones = 96;
    const auto radius = [](const Station& s) {
        return static_cast<float>(s.radius) - muscle_thickness - skin_thickness;
    };
    Union chain;
    for (int i = 0; i < cones; ++i) {
        const Station &a = line[static_cast<std::size_t>(i * steps / cones)],
                      &b = line[static_cast<std::size_t>((i + 1) * steps / cones)];
        chain.of.push_back(RoundCone{glm::vec3(a.at), radius(a), glm::vec3(b.at), radius(b)});
    }
    return chain;
}

Field bumps_on(const std::vector<Station>& line, int count) {
    // Balls of radius k·r, evenly by their own size: their density along the curve is as 1/r.
    std::vector<double> before{0};
    double area = 0;
    const double step = glm::length(line[1].at - line[0].at);
    for (int i = 0; i < steps; ++i) {
        const double r = line[static_cast<std::size_t>(i)].radius;
        before.push_back(before.back() + 1 / r);
        area += 2 * std::numbers::pi * r * step;
    }
    std::vector<const Station*> stations;
    double squares = 0;
    std::size_t at = 0;
    for (int i = 0; i < count; ++i) {
        const double wanted = (i + 0.5) / count * before.back();
        while (before[at + 1] < wanted) ++at;
        stations.push_back(&line[at]);
        squares += line[at].radius * line[at].radius;
    }
    const double k = std::sqrt(covered * area / (std::numbers::pi * squares));
    FieldInstances balls;
    balls.of = Sphere{1};
    for (int i = 0; i < count; ++i) {
        const Station& s = *stations[static_cast<std::size_t>(i)];
        const double angle = std::fmod(i * std::numbers::pi * (3 - std::sqrt(5.0)), 2 * std::numbers::pi);
        balls.positions.emplace_back(s.at + (s.side * std::cos(angle) + s.up * std::sin(angle)) * s.radius);
        balls.scales.push_back(static_cast<float>(k * s.radius));
    }
    return balls;
}

// What lies in front of a plane (towards the camera) and below a height.
Field step_cut(float depth, float height) {
    return Intersection{{Plane{{0, 1, 0}, -depth}, Plane{{0.1f, 0, 1}, height}}};
}

}  // namespace

Phased tentacle(int bumps) {
    const std::vector<Station> line = centre_line();
    Phased arm = LayeredSequence{
        .of = Set{core, core_of(line)}, .layers = {muscle, skin}, .thicknesses = {muscle_thickness, skin_thickness}};
    arm = Under{{Set{bump, bumps_on(line, bumps)}, arm}};
    const Phase outer[] = {skin, bump};
    arm = SubtractShape{arm, step_cut(0.25f, 2.6f), PhaseSet::of(outer)};
    arm = SubtractShape{arm, step_cut(0.35f, 1.9f), PhaseSet::of(muscle)};
    return SubtractShape{arm, step_cut(0.45f, 1.1f), PhaseSet::of(core)};
}

}  // namespace phasetree::bench
