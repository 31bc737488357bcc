// Integer hashing: the only source of pseudo-randomness for samples and textures.
//
// The finaliser is Wellons's "triple32" (Prospecting for Hash Functions, 2018), a bijection of 32-bit integers with
// nearly ideal avalanche. Several words are chained through it.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

constexpr std::uint32_t mix_bits(std::uint32_t x) {
    x ^= x >> 17;
    x *= 0xed5ad4bbu;
    x ^= x >> 11;
    x *= 0xac4c1b51u;
    x ^= x >> 15;
    x *= 0x31848babu;
    x ^= x >> 14;
    return x;
}

template <typename... Words>
constexpr std::uint32_t hash(std::uint32_t first, Words... rest) {
    std::uint32_t state = mix_bits(first + 0x9e3779b9u);
    ((state = mix_bits(state * 0x01000193u ^ (static_cast<std::uint32_t>(rest) + 0x9e3779b9u))), ...);
    return state;
}

/// The hash of a point or direction, from all bits of its components, and of further words.
template <typename... Words>
std::uint32_t hash_of(const glm::vec3& v, Words... rest) {
    return hash(std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y), std::bit_cast<std::uint32_t>(v.z),
                rest...);
}

/// Maps a hash to [0, 1).
constexpr float hash_to_unit(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace phasetree::tracer
