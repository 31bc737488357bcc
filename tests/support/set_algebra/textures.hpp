#pragma once

/// Fields that are numbers by their meaning: periodic walls and noise.

#include "support/set_algebra.hpp"
#include "tree/node.hpp"

namespace phasetree::tests::oracle {

/// From g of the angles to the wall: sup‖∇g‖ is √3 · 2π/period.
template <class N>
double wall(const N& n, double g) {
    return std::abs(g) * n.period / (std::sqrt(3.0) * 6.283185307179586) - n.thickness / 2.0;
}
inline double signed_value(const Gyroid& n, const dvec3& p) {
    const dvec3 a = p * (6.283185307179586 / static_cast<double>(n.period)), s = glm::sin(a), c = glm::cos(a);
    return wall(n, s.x * c.y + s.y * c.z + s.z * c.x);
}
inline double signed_value(const SchwarzP& n, const dvec3& p) {
    const dvec3 c = glm::cos(p * (6.283185307179586 / static_cast<double>(n.period)));
    return wall(n, c.x + c.y + c.z);
}
inline double signed_value(const SchwarzD& n, const dvec3& p) {
    const dvec3 a = p * (6.283185307179586 / static_cast<double>(n.period)), s = glm::sin(a), c = glm::cos(a);
    return wall(n, s.x * s.y * s.z + s.x * c.y * c.z + c.x * s.y * c.z + c.x * c.y * s.z);
}
inline bool member(const Gyroid& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const SchwarzP& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const SchwarzD& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

/// Noise by whole numbers: the lattice's values, blended over the eight corners of a cell.
inline double lattice_value(const long long (&c)[3]) {
    const auto wrap = [](long long v) { return ((v % 289) + 289) % 289; };
    long long h = 0;
    for (const long long v : c) {
        const long long x = wrap(h + v);
        h = wrap((34 * x + 5) * x);
    }
    return static_cast<double>(h) / 144 - 1;
}
inline double value_noise(const dvec3& u) {
    const dvec3 whole = glm::floor(u), t = u - whole;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        long long c[3];
        for (int i = 0; i < 3; ++i) {
            const bool high = (corner >> i) & 1;
            const double blend = t[i] * t[i] * t[i] * (10 + t[i] * (6 * t[i] - 15));
            weight *= high ? blend : 1 - blend;
            c[i] = static_cast<long long>(whole[i]) + high;
        }
        sum += weight * lattice_value(c);
    }
    return sum;
}
inline double fractal_noise(dvec3 u, int octaves) {
    u = glm::clamp(u, dvec3(-65536), dvec3(65536));
    double sum = 0, weights = 0;
    for (int i = 0; i < octaves; ++i) {
        sum += std::ldexp(value_noise(u), -i);
        weights += std::ldexp(1.0, -i);
        u = 2.0 * u + dvec3(19.25, 47.375, 71.5625);
    }
    return sum / weights;
}
inline double displaced(const Displace& n, const dvec3& p) {
    return value(n.of, p) + n.amplitude * fractal_noise(p / static_cast<double>(n.scale), static_cast<int>(n.octaves));
}
inline double signed_value(const Displace& n, const dvec3& p) {
    const double f = value(n.of, p), a = n.amplitude;
    const double slope = 3.75 * n.octaves / (n.scale * (2 - std::exp2(1.0 - n.octaves)));
    return std::clamp(displaced(n, p) / (1 + a * slope), f - a, f + a);
}
inline bool member(const Displace& n, const dvec3& p) {
    return displaced(n, p) < 0;
}

}  // namespace phasetree::tests::oracle
