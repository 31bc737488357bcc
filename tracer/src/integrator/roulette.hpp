// Russian roulette: the probability that a path survives, from the light that it can still contribute.
#pragma once

#include <algorithm>

namespace phasetree::tracer {

/// Returns the probability; 1 if no random number is to be drawn. `worth` is the share of its initial contribution that
/// the path can still make. `depth` is the number of surfaces and scattering events of the path so far.
///
/// The first three surfaces or scattering events are exempt, so that a path reaches what is visible behind a wall of
/// glass (two interfaces). After that, the probability is four times the share, so a path with a share of at least a
/// quarter always survives. In long chains of clear interfaces, the noise from terminating paths costs more than the
/// saved steps. At least a twentieth of the paths survive, so that no weight grows by more than 20 at once.
/// Probabilities that are nearly 1 are rounded up to 1.
///
/// Variance × render time for several values of this factor (survival_per_worth), relative to a factor of 1:
///
///     factor       1      4      16
///     glasses      1     0.5    0.49
///     hourglass    1     0.82   0.85
inline float roulette_survival(float worth, int depth) {
    constexpr int depth_without_roulette = 3;
    constexpr float survival_per_worth = 4.0f, least = 0.05f, nearly_certain = 0.95f;
    const float survival = std::max(survival_per_worth * worth, least);
    return depth > depth_without_roulette && survival < nearly_certain ? survival : 1.0f;
}

}  // namespace phasetree::tracer
