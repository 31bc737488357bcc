// Phase functions in double precision, from the equations of the papers that tracer/src/media cites.
#pragma once

#include <cmath>
#include <numbers>

namespace phasetree::tests {

// Henyey and Greenstein's with α = 0, and Rayleigh's with g = 0 and α = 1.
inline double draine_density(double g, double alpha, double mu) {
    return (1 - g * g) / std::pow(1 + g * g - 2 * g * mu, 1.5) * (1 + alpha * mu * mu) /
           (1 + alpha * (1 + 2 * g * g) / 3) / (4 * std::numbers::pi);
}

// `d` is the diameter in micrometres.
inline double droplets_density(double d, double mu) {
    const double share = std::exp(-0.599085 / (d - 0.641583) - 0.665888);
    const double forward = std::exp(-0.0990567 / (d - 1.67154));
    const double wide = std::exp(-2.20679 / (d + 3.91029) - 0.428934);
    const double alpha = std::exp(3.62489 - 8.29288 / (d + 5.52825));
    return (1 - share) * draine_density(forward, 0, mu) + share * draine_density(wide, alpha, mu);
}

}  // namespace phasetree::tests
