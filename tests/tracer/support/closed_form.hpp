// Closed forms for the optics of plane layers and spheres, from textbooks and in double precision, for tests.
//
// Reflectances are those of unpolarised light at every interface, as in path tracers without polarisation: the mean of
// both polarisations is taken at each interface, not once for the whole stack.
//
// References: Born & Wolf, Principles of Optics, 7th ed., 1.5 (Fresnel); van de Hulst, Multiple Light Scattering,
// 1980, chapter 4 (adding method).
#pragma once

#include <cmath>
#include <span>

namespace phasetree::tests {

// For a ray that arrives at cos_from in index `from` and meets index `to`.
inline double fresnel(double cos_from, double from, double to) {
    const double sin_to = from / to * std::sqrt(1 - cos_from * cos_from);
    if (sin_to >= 1) return 1;
    const double cos_to = std::sqrt(1 - sin_to * sin_to);
    const double s = (from * cos_from - to * cos_to) / (from * cos_from + to * cos_to);
    const double p = (to * cos_from - from * cos_to) / (to * cos_from + from * cos_to);
    return (s * s + p * p) / 2;
}

// By Snell's law from vacuum.
inline double cosine_within(double cos_vacuum, double ior) {
    return std::sqrt(1 - (1 - cos_vacuum * cos_vacuum) / (ior * ior));
}

struct Layer {
    double ior;
    double absorption;  // per unit length
    double thickness;
};

// The reflected and transmitted shares of the incident basic radiance.
struct Response {
    double reflected, transmitted;
};

// A stack of touching layers between vacuum and vacuum, seen at this cosine. Interfaces and layers are added one by
// one; each addition sums the geometric series of the light between two parts.
inline Response stack(double cos_vacuum, std::span<const Layer> layers) {
    double ior = 1, cosine = cos_vacuum, absorbed = 1;
    // From the front: reflected, transmitted; from behind: the same (transmission is symmetric in basic radiance).
    double r = 0, t = 1, r_behind = 0;
    const auto add = [&](double next_ior) {
        const double f = fresnel(cosine, ior, next_ior);
        const double series = 1 / (1 - r_behind * absorbed * absorbed * f);
        const double r_all = r + t * t * absorbed * absorbed * f * series;
        const double r_behind_all = f + (1 - f) * (1 - f) * absorbed * absorbed * r_behind * series;
        t *= absorbed * (1 - f) * series;
        r = r_all;
        r_behind = r_behind_all;
        ior = next_ior;
        cosine = cosine_within(cos_vacuum, next_ior);
    };
    for (const Layer& layer : layers) {
        add(layer.ior);
        absorbed = std::exp(-layer.absorption * layer.thickness / cosine);
    }
    add(1);
    return {r, t};
}

// A slab alone, by its own well-known sums: T = (1−F)² a/(1−F² a²), R = F + F (1−F)² a²/(1−F² a²).
inline Response slab(double cos_vacuum, const Layer& layer) {
    const double f = fresnel(cos_vacuum, 1, layer.ior);
    const double a = std::exp(-layer.absorption * layer.thickness / cosine_within(cos_vacuum, layer.ior));
    const double series = (1 - f) * (1 - f) / (1 - f * f * a * a);
    return {f + f * a * a * series, a * series};
}

// A sphere seen along a ray that passes its centre at b radii, in light of radiance 1 from everywhere. Inside, every
// chord has the same length 2r cos θ and every bounce the same F, so L = F + (1−F)² Σ aⁿ⁺¹ Fⁿ.
inline double sphere_in_uniform_light(double b, double radius, double ior, double absorption) {
    const double cosine = std::sqrt(1 - b * b);
    const double f = fresnel(cosine, 1, ior);
    const double a = std::exp(-absorption * 2 * radius * cosine_within(cosine, ior));
    return f + (1 - f) * (1 - f) * a / (1 - f * a);
}

// ∫ g(μ) dμ over [0, 1]: midpoints in x with μ = x²(3 − 2x), which tames the ends' roots and exponentials.
template <class G>
double integrate_cosines(G&& g, int steps = 20000) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = (i + 0.5) / steps;
        sum += g(x * x * (3 - 2 * x)) * 6 * x * (1 - x);
    }
    return sum / steps;
}

}  // namespace phasetree::tests
