#include "shading/texture/noise.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
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

// Values far beyond the resolution of floats, and NaN, are all in one cube.
Lattice locate(const glm::vec3& p) {
    const auto split = [](float value, float& inside) {
        if (!(std::abs(value) < 1e9f)) {
            inside = 0.0f;
            return std::int32_t{0};
        }
        const auto truncated = static_cast<std::int32_t>(value);
        const std::int32_t below = truncated - (value < static_cast<float>(truncated) ? 1 : 0);
        inside = value - static_cast<float>(below);
        return below;
    };
    Lattice lattice{};
    lattice.x = split(p.x, lattice.inside.x);
    lattice.y = split(p.y, lattice.inside.y);
    lattice.z = split(p.z, lattice.inside.z);
    return lattice;
}

// One multiplication per axis before the finaliser, with the constants of Teschner, Heidelberger, Müller, Pomerantes &
// Gross, Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003. `seed` is itself a hash.
std::uint32_t hash_cube(std::int32_t x, std::int32_t y, std::int32_t z, std::uint32_t seed) {
    return mix_bits(seed ^ (static_cast<std::uint32_t>(x) * 73856093u) ^ (static_cast<std::uint32_t>(y) * 19349663u) ^
                    (static_cast<std::uint32_t>(z) * 83492791u));
}

// Dot product with the direction to the centre of one of a cube's twelve edges, as in Perlin's noise: in groups of
// four, ±x ± y, ±x ± z, ±y ± z. Without branches, which would be unpredictable.
float along_gradient(std::uint32_t bits, float x, float y, float z) {
    const std::uint32_t edge = bits % 12u;
    const float first = edge < 8u ? x : y, second = edge < 4u ? y : z;
    const auto with_sign = [](float value, std::uint32_t negative) {
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ (negative << 31));
    };
    return with_sign(first, edge >> 1 & 1u) + with_sign(second, edge & 1u);
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
        // Not exactly doubled, so that the zeros of the octaves do not coincide.
        q = q * 2.03f + glm::vec3{0.37f, 0.71f, 0.53f};
    }
    return sum;
}

Cell cellular_noise(const glm::vec3& p, std::uint32_t seed) {
    const Lattice l = locate(p);
    const std::uint32_t lattice_seed = mix_bits(seed + 0x9e3779b9u);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    float nearest = infinity, next = infinity;  // squared
    std::uint32_t nearest_id = 0;
    const auto look_in = [&](int i, int j, int k) {
        const std::uint32_t id = hash_cube(l.x + i, l.y + j, l.z + k, lattice_seed);
        const glm::vec3 point{static_cast<float>(i) + hash_to_unit(hash(id, 1u)),
                              static_cast<float>(j) + hash_to_unit(hash(id, 2u)),
                              static_cast<float>(k) + hash_to_unit(hash(id, 3u))};
        const glm::vec3 apart = point - l.inside;
        const float squared = glm::dot(apart, apart);
        if (squared < nearest) {
            next = nearest;
            nearest = squared;
            nearest_id = id;
        } else if (squared < next) {
            next = squared;
        }
    };
    // First the cubes next to p. Few of the others are as near as the second point found there.
    const auto side = [](float inside) { return inside < 0.5f ? -1 : 1; };
    const int si = side(l.inside.x), sj = side(l.inside.y), sk = side(l.inside.z);
    for (int corner = 0; corner < 8; ++corner) look_in(corner & 1 ? si : 0, corner & 2 ? sj : 0, corner & 4 ? sk : 0);
    // Squared distance to the cubes at offset i.
    const auto squared_gap = [](int i, float inside) {
        const float gap = i < 0 ? inside - static_cast<float>(i + 1) : i > 0 ? static_cast<float>(i) - inside : 0.0f;
        return gap * gap;
    };
    const auto look_around = [&](int reach, const auto& is_seen) {
        for (int k = -reach; k <= reach; ++k) {
            for (int j = -reach; j <= reach; ++j) {
                const float gap = squared_gap(k, l.inside.z) + squared_gap(j, l.inside.y);
                for (int i = -reach; i <= reach; ++i)
                    if (!is_seen(i, j, k) && gap + squared_gap(i, l.inside.x) < next) look_in(i, j, k);
            }
        }
    };
    look_around(1, [&](int i, int j, int k) { return i != -si && j != -sj && k != -sk; });
    // Cubes beyond those are more than 1 away. Two points are always within √3: that of p's own cube and that of the
    // cube across its nearest face. So no relevant cube lies beyond the next layer, which is 2 away.
    if (next > 1.0f)
        look_around(2, [](int i, int j, int k) { return std::max({std::abs(i), std::abs(j), std::abs(k)}) < 2; });
    return {std::sqrt(nearest), std::sqrt(next), nearest_id};
}

}  // namespace phasetree::tracer
