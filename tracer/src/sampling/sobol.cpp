#include "sampling/sobol.hpp"

#include "sampling/hash.hpp"

namespace phasetree::tracer {

namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);  // together with the next line, a byte swap
    return (x >> 16) | (x << 16);
}

// The Laine-Karras permutation: a bit of the result depends only on that bit and the bits below it. Constants by
// Vegdahl (Building a Better LK Hash, 2021), which avalanche better than those first published.
std::uint32_t laine_karras_permutation(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The generator matrix of the second dimension, before its digits are reversed to form a fraction, is Pascal's triangle
// modulo 2: the five-fold Kronecker power of (1 1; 0 1). Digit r is the exclusive or of all bits of the index whose
// number contains the bits of r. One step per Kronecker factor.
std::uint32_t pascal(std::uint32_t index) {
    index ^= (index & 0xaaaaaaaau) >> 1;
    index ^= (index & 0xccccccccu) >> 2;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xffff0000u) >> 16;
    return index;
}

// nested_uniform_scramble() of a fraction whose bits are reversed, as initially in the sequence.
std::uint32_t scrambled(std::uint32_t reversed_fraction, std::uint32_t seed) {
    return reverse_bits(laine_karras_permutation(reversed_fraction, seed));
}

float to_unit_interval(std::uint32_t fraction) {
    return static_cast<float>(fraction >> 8) * 0x1p-24f;
}

}  // namespace

std::uint32_t sobol_first(std::uint32_t index) {
    return reverse_bits(index);
}

std::uint32_t sobol_second(std::uint32_t index) {
    return reverse_bits(pascal(index));
}

std::uint32_t nested_uniform_scramble(std::uint32_t fraction, std::uint32_t seed) {
    return scrambled(reverse_bits(fraction), seed);
}

Sampler::Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t sample, std::uint32_t seed)
    : reversed_sample_(reverse_bits(sample)), pixel_(hash(x, y, seed)) {}

// The hashes of a pixel's groups: a finaliser over a Weyl sequence.
Sampler::Group Sampler::next_group() {
    const std::uint32_t group = mix_bits(pixel_ + 0x9e3779b9u * ++group_);
    return {scrambled(reversed_sample_, group), group ^ 0x5bf03635u};
}

float Sampler::next() {
    const Group group = next_group();
    return to_unit_interval(scrambled(group.index, mix_bits(group.scramble)));
}

float Sampler::next_evenly() {
    const std::uint32_t shift = mix_bits(next_group().scramble);
    return to_unit_interval(reversed_sample_ ^ shift);
}

glm::vec2 Sampler::next2() {
    const Group group = next_group();
    return {to_unit_interval(scrambled(group.index, mix_bits(group.scramble))),
            to_unit_interval(scrambled(pascal(group.index), mix_bits(~group.scramble)))};
}

}  // namespace phasetree::tracer
