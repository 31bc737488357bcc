// Simple shapes in three phases, and random numbers, for tests that know labels in closed form.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"

namespace phasetree::tests::simple {

using Point = glm::dvec3;

inline constexpr Phase glass{1}, water{2}, iron{3};

inline Field ball(const Point& centre, double radius) {
    return warped(Translate{.by = glm::vec3(centre)}, Field(Sphere{.radius = static_cast<float>(radius)}));
}
inline Field block(const Point& half) {
    return Box{.size = 2.f * glm::vec3(half)};
}
inline Phased set(Phase phase, const Field& of) {
    return Set{.phase = phase, .of = of};
}

struct UniformReals {
    std::mt19937 engine;
    double operator()(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine() >> 8) / static_cast<double>(1 << 24));
    }
    Point direction() {
        for (;;) {
            const Point p((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
            if (const double length = glm::length(p); length > 0.1 && length < 1) return p / length;
        }
    }
};

}  // namespace phasetree::tests::simple
