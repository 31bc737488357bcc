#pragma once

#include "phasetree/math/value_noise.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// Octaves of value noise (math/value_noise.hpp), whose slope is 15/4 at most.
///
/// *Octaves:* each has half the size and half the weight of the one before, so each adds as much slope. The weights'
/// sum is 1, so the range is [−1, 1].
///
/// *Positions* are projected onto a cube of 2¹⁷ sizes, which lengthens nothing; beyond it the noise is constant along
/// the cube's normals. So the lattice's hash (math/lattice_hash.hpp) gets numbers that it computes exactly.
///
/// distance() is the noise divided by its slope's bound, hence 1-Lipschitz, as every primitive.
struct FractalNoise {
    static constexpr bool is_long = true;  ///< a LongPrimitive
    float frequency = 1;                   ///< 1/size of the first octave
    float octaves = 1;
    float weight = 1 / steepest;  ///< of the first octave

    /// A bound of the slope of noise in [−1, 1].
    static float slope(float size, float octaves) { return steepest * octaves / (size * weights(octaves)); }

    FractalNoise() = default;
    FractalNoise(float size, float count) : frequency(1.f / size), octaves(count), weight(size / (steepest * count)) {}

    template <class T>
    T distance(const Vec3<T>& p) const {
        const T far(65536.f);
        T x = clamp(p.x * frequency, -far, far), y = clamp(p.y * frequency, -far, far),
          z = clamp(p.z * frequency, -far, far);
        float share = weight;
        T sum(0.f);
        for (int i = 0; i < static_cast<int>(octaves); ++i) {
            sum = sum + value_noise(Vec3<T>{x, y, z}) * share;
            // Octaves are shifted against each other, so that their lattices share no point.
            x = x * 2.f + 19.25f;
            y = y * 2.f + 47.375f;
            z = z * 2.f + 71.5625f;
            share *= 0.5f;
        }
        return sum;
    }

    /// The weight of the first octave.
    float period() const { return 1 / frequency; }

  private:
    static constexpr float steepest = 3.75f;

    /// The sum Σ 2⁻ⁱ over the octaves.
    static float weights(float octaves) { return 2.f - std::exp2(1.f - octaves); }
};

}  // namespace phasetree
