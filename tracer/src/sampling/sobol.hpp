// Owen-scrambled Sobol' samples, padded to any number of dimensions.
//
// Every call of next() or next2() is a group of its own: it draws from the one- or two-dimensional Sobol' sequence,
// with its own shuffle of the sample index and its own scramble, both hashed from pixel, seed and group. Each group is
// therefore a scrambled (0,1)- or (0,2)-sequence over the samples of a pixel, and groups are independent. Groups of two
// are on purpose: in base 2 only the first pair of Sobol' dimensions is a (0,2)-sequence, and what a path tracer draws
// comes in pairs (pixel, lens, direction, point of a light).
//
// A sample depends on (x, y, sample, seed) and on how many groups were drawn before, and on nothing else: images are
// the same for every order of execution, and a render can go on from any sample number.
//
// References: Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020; Owen, Randomly Permuted (t,m,s)-Nets and
// (t,s)-Sequences, 1995; Laine & Karras, Stratified Sampling for Stochastic Transparency, EGSR 2011.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

namespace phasetree::tracer {

class Sampler {
  public:
    /// `sample` is the absolute number of the sample in its pixel: 0, 1, 2 …
    Sampler(std::uint32_t x, std::uint32_t y, std::uint32_t sample, std::uint32_t seed);

    /// In [0, 1): a multiple of 2⁻²⁴, never 1.
    float next();
    glm::vec2 next2();
    /// A number like that of next(), also a group of its own, of which those of 2ᵐ samples of a pixel, if these begin
    /// at a multiple of 2ᵐ, are 2⁻ᵐ apart: each bit is flipped or not, alike for all samples. So nothing but where they
    /// begin is random. It integrates what is smooth with far less noise than numbers that are each random within
    /// 2⁻ᵐ, as those of next() are.
    float next_evenly();

  private:
    struct Group {
        std::uint32_t index;  ///< shuffled sample index
        std::uint32_t scramble;
    };
    Group next_group();

    std::uint32_t reversed_sample_;
    std::uint32_t pixel_;      ///< hash of pixel and seed
    std::uint32_t group_ = 0;  ///< groups drawn so far
};

/// The sequence itself, as 32-bit fractions, before any scrambling.
std::uint32_t sobol_first(std::uint32_t index);
std::uint32_t sobol_second(std::uint32_t index);

/// Owen's nested uniform scramble: every bit is flipped or not depending on all higher bits and the seed.
std::uint32_t nested_uniform_scramble(std::uint32_t fraction, std::uint32_t seed);

}  // namespace phasetree::tracer
