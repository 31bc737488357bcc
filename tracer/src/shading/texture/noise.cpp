#include "shading/texture/noise.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "sampling/hash.hpp"

namespace phasetree::tracer {

namespace {

struct Lattice {
    std::int32_t x, y, z;  // of the cube's lowest corner
    glm::vec3 inside;      // in [0, 1]
};

// Far outside of what floats resolve, and for what is no number, everything is one cube.
Lattice locate(const glm::vec3& p) {
    const auto split = [](float value, float& inside) {
        if (!(std::abs(value) < 1e9f)) {
            inside = 0.0f;
            return std::int32_t{0};
        }
        const float below = std::floor(value);
        inside = value - below;
        return static_cast<std::int32_t>(below);
    };
    Lattice lattice{};
    lattice.x = split(p.x, lattice.inside.x);
    lattice.y = split(p.y, lattice.inside.y);
    lattice.z = split(p.z, lattice.inside.z);
    return lattice;
}

// One multiplication an axis before the finaliser, with the constants of Teschner, Heidelberger, Müller, Pomerantes &
// Gross, Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003. `seed` is itself a hash.
std::uint32_t hash_cube(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    return mix_bits(seed ^ (static_cast<std::uint32_t>(x) * 73856093u) ^ (static_cast<std::uint32_t>(y) * 19349663u) ^
                    (static_cast<std::uint32_t>(z) * 83492791u));
}

// Towards the middle of one of a cube's twelve edges, as Perlin chose them.
float along_gradient(std::uint32_t bits, float x, float y, float z) {
    switch (bits % 12u) {
        case 0:
            return x + y;
        case 1:
            return x - y;
        case 2:
            return -x + y;
        case 3:
            return -x - y;
        case 4:
            return x + z;
        case 5:
            return x - z;
        case 6:
            return -x + z;
        case 7:
            return -x - z;
        case 8:
            return y + z;
        case 9:
            return y - z;
        case 10:
            return -y + z;
        default:
            return -y - z;
    }
}

float fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

}  // namespace

float gradient_noise(const glm::vec3& p, std::uint32_t seed) {
    const Lattice l = locate(p);
    const std::uint32_t lattice_seed = mix_bits(seed + 0x9e3779b9u);
    const auto corner = [&](int i, int j, int k) {
        return along_gradient(hash_cube(l.x + i, l.y + j, l.z + k, lattice_seed), l.inside.x - static_cast<float>(i),
                              l.inside.y - static_cast<float>(j), l.inside.z - static_cast<float>(k));
    };
    const float u = fade(l.inside.x);
    const float v = fade(l.inside.y);
    const float w = fade(l.inside.z);
    const auto edge = [&](int j, int k) { return glm::mix(corner(0, j, k), corner(1, j, k), u); };
    const auto face = [&](int k) { return glm::mix(edge(0, k), edge(1, k), v); };
    return glm::mix(face(0), face(1), w);
}

float fractal_noise(const glm::vec3& p, int octaves, std::uint32_t seed) {
    float sum = 0.0f;
    float amplitude = 1.0f;
    glm::vec3 q = p;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude * gradient_noise(q, hash(seed, static_cast<std::uint32_t>(octave)));
        amplitude *= 0.5f;
        // Not exactly doubled, so that the zeros of the octaves do not fall together.
        q = q * 2.03f + glm::vec3{0.37f, 0.71f, 0.53f};
    }
    return sum;
}

Cell cellular_noise(const glm::vec3& p, std::uint32_t seed) {
    const Lattice l = locate(p);
    const std::uint32_t lattice_seed = mix_bits(seed + 0x9e3779b9u);
    Cell cell{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(), 0u};
    for (int k = -1; k <= 1; ++k) {
        for (int j = -1; j <= 1; ++j) {
            for (int i = -1; i <= 1; ++i) {
                const std::uint32_t id = hash_cube(l.x + i, l.y + j, l.z + k, lattice_seed);
                const glm::vec3 point{static_cast<float>(i) + hash_to_unit(hash(id, 1u)),
                                      static_cast<float>(j) + hash_to_unit(hash(id, 2u)),
                                      static_cast<float>(k) + hash_to_unit(hash(id, 3u))};
                const float distance = glm::length(point - l.inside);
                if (distance < cell.nearest) {
                    cell.next = cell.nearest;
                    cell.nearest = distance;
                    cell.id = id;
                } else if (distance < cell.next) {
                    cell.next = distance;
                }
            }
        }
    }
    return cell;
}

}  // namespace phasetree::tracer
