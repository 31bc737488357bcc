// Owen-scrambled Sobol' samples, padded to any number of dimensions.
//
// Every call of next() or next2() is a separate group: it draws from the one- or two-dimensional Sobol' sequence, with
// its own shuffle of the sample index and its own scramble, both hashed from pixel, seed and group. Each group is
// therefore a scrambled (0,1)- or (0,2)-sequence over the samples of a pixel, and groups are independent. Groups have
// at most two dimensions because in base 2 only the first pair of Sobol' dimensions is a (0,2)-sequence, and the
// samples of a path tracer come in pairs (pixel, lens, direction, point of a light).
//
// A sample depends only on (x, y, sample, seed) and on the number of groups drawn before. So images do not depend on
// the order of execution, and a render can continue at any sample number.
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

    /// Returns a number in [0, 1): a multiple of 2⁻²⁴, never 1.
    float next();
    glm::vec2 next2();
    /// Like next(), also as a separate group, but with equal spacing: the numbers of 2ᵐ samples of a pixel that start
    /// at a multiple of 2ᵐ are 2⁻ᵐ apart. Each bit is flipped or not, the same for all samples, so only the offset is
    /// random. For smooth integrands this has far less noise than next(), whose numbers are each random within 2⁻ᵐ.
    float next_evenly();

  private:
    struct Group {
        std::uint32_t index;  ///< shuffled sample index
        std::uint32_t scramble;
    };
    Group next_group();

    std::uint32_t reversed_sample_;
    std::uint32_t pixel_;      ///< hash of pixel and seed
    std::uint32_t group_ = 0;  ///< number of groups drawn so far
};

/// The Sobol' sequence, as 32-bit fractions, before scrambling.
std::uint32_t sobol_first(std::uint32_t index);
std::uint32_t sobol_second(std::uint32_t index);

/// Owen's nested uniform scramble: whether a bit is flipped depends on all higher bits and the seed.
std::uint32_t nested_uniform_scramble(std::uint32_t fraction, std::uint32_t seed);

}  // namespace phasetree::tracer
