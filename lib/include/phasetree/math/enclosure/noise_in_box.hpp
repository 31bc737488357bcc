#pragma once

#include "phasetree/math/dual.hpp"
#include "phasetree/math/enclosure/field_in_box.hpp"
#include "phasetree/nodes/fields/fractal_noise.hpp"

namespace phasetree {

/// Noise by its gradient at the centre and how much it bends. The box must lie within its cube.
inline FieldInBox noise_in_box(const FractalNoise& noise, const Region& at) {
    const Vec3<float> p = at.point();
    const Dual f = noise.distance(Vec3<Dual>{Dual(p.x, 1, 0, 0), Dual(p.y, 0, 1, 0), Dual(p.z, 0, 0, 1)});
    const double bend = noise.curvature(), change = bend * std::hypot(at.reach[0], at.reach[1], at.reach[2]);
    FieldInBox result;
    result.value = static_cast<double>(f.value());
    result.curvature = within(bend);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto g = static_cast<double>(f.gradient()[static_cast<int>(i)]);
        result.gradient[i] = g;
        result.gradients[i] = {std::max(-1.0, g - change), std::min(1.0, g + change)};
    }
    return result;
}

}  // namespace phasetree
