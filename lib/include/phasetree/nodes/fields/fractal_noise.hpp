#pragma once

#include "phasetree/math/portable.hpp"
#include "phasetree/math/value_noise.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// Octaves of value noise (math/value_noise.hpp), whose slope is at most 15/4.
///
/// *Octaves.* Each has half the size and half the weight of the previous one, so each adds the same slope. The weights
/// sum to 1, so the range is [−1, 1].
///
/// *Positions* are clamped to a cube with sides of 2¹⁷ · size, which never increases distances. Beyond the cube the
/// noise is constant along its normals. The lattice's hash (math/lattice_hash.hpp) therefore only receives numbers that
/// it computes exactly.
///
/// distance() is the noise divided by the bound on its slope, and therefore 1-Lipschitz like every primitive.
struct FractalNoise {
    static constexpr bool is_long = true;  ///< a LongPrimitive
    static constexpr unsigned half_instructions = 120;
    static constexpr EnclosedBy enclosed_by = EnclosedBy::equation;
    float frequency = 1;  ///< 1/size of the first octave
    float octaves = 1;
    float weight = 1 / steepest;  ///< of the first octave

    /// A bound of the slope of the noise when scaled to [−1, 1].
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
            // Octaves are offset against each other so that their lattices share no point.
            x = x * 2.f + 19.25f;
            y = y * 2.f + 47.375f;
            z = z * 2.f + 71.5625f;
            share *= 0.5f;
        }
        return sum;
    }

    /// The size of the first octave.
    float period() const { return 1 / frequency; }

  private:
    static constexpr float steepest = 3.75f;

    /// The sum Σ 2⁻ⁱ over the octaves.
    static float weights(float octaves) { return 2.f - portable::exp2(1.f - octaves); }
};

}  // namespace phasetree
