// Noise for solid textures: smooth, deterministic, without tables.
//
// References: Perlin, Improving Noise, SIGGRAPH 2002 (gradient noise with the quintic fade); Worley, A Cellular Texture
// Basis Function, SIGGRAPH 1996.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// Gradient noise of wavelength 1: 0 at integer points, mostly within ±0.8, always within ±1.
float gradient_noise(const glm::vec3& p, std::uint32_t seed);

/// Octaves of gradient noise, each with half the wavelength and half the amplitude of the previous one; within ±2.
float fractal_noise(const glm::vec3& p, int octaves, std::uint32_t seed);

struct Cell {
    float nearest;     ///< distance to the nearest feature point
    float next;        ///< to the second nearest
    std::uint32_t id;  ///< hash of the Voronoi cell of the nearest point, constant in that cell
};

/// Cellular noise: one feature point per unit cube.
Cell cellular_noise(const glm::vec3& p, std::uint32_t seed);

}  // namespace phasetree::tracer
