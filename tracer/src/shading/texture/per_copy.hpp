// Variation among copies of one object. Each copy placed by a scene's "instances" has a random number in [0, 1), a hash
// of the copy's number and a seed, which is constant over the copy. Objects that exist once, and all meshes, have the
// number of the first copy.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "phasetree/io/kind.hpp"
#include "sampling/hash.hpp"
#include "shading/texture/ramp_of_numbers.hpp"
#include "shading/texture/ramp_of_textures.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

inline float random_of_copy(std::uint32_t copy, int seed) {
    return hash_to_unit(hash(copy, static_cast<std::uint32_t>(seed)));
}

inline constexpr Parameter per_copy_seed{
    "seed", "", "Seed of the random numbers; parameters with the same seed vary together.", limits::non_negative, true};

struct PerCopyTexture {
    static constexpr KindInfo info{
        "per_copy",
        "A random colour or texture for each copy made by \"instances\", so that leaves or pebbles differ."};

    TextureRamp ramp{};
    int seed = 0;

    template <class V>
    static void parameters(V&& v) {
        using P = PerCopyTexture;
        v(&P::ramp, RampParameter{{"ramp", "",
                                   "Random numbers from 0 to 1 and the colour or texture of a copy with that number, "
                                   "with interpolation in between.",
                                   limits::fraction}});
        v(&P::seed, per_copy_seed);
    }

    glm::vec3 at(const TexturePoint& p) const { return color_at(ramp, random_of_copy(p.copy, seed), p, nullptr); }
    glm::vec3 at(const TexturePoint& p, const Wavelengths& wavelengths) const {
        return color_at(ramp, random_of_copy(p.copy, seed), p, &wavelengths);
    }
};

struct PerCopyNumber {
    static constexpr KindInfo info{"per_copy", "A random number for each copy made by \"instances\"."};

    std::vector<NumberStop> ramp{};
    int seed = 0;

    template <class V>
    static void parameters(V&& v) {
        using P = PerCopyNumber;
        v(&P::ramp,
          RampParameter{
              {"ramp", "",
               "Random numbers from 0 to 1 and the value of a copy with that number, with interpolation in between."}});
        v(&P::seed, per_copy_seed);
    }

    float at(const TexturePoint& p) const { return number_at(ramp, random_of_copy(p.copy, seed)); }
    float least() const { return least_of(ramp); }
    float greatest() const { return greatest_of(ramp); }
};

}  // namespace phasetree::tracer
