// Russian roulette: the probability with which a path survives, by how much light it can still bring.
#pragma once

#include <algorithm>

namespace phasetree::tracer {

/// The probability; 1 if no number is to be drawn. `worth` is the share of what
/// it began with that the path can still bring, and `depth` how many surfaces and places in
/// media the path has met.
///
/// Roulette spares the first three of them: with a wall of glass in front, that is as far as what is seen behind it.
/// After that the probability is four times the share, so a path survives for certain from a quarter on, because in
/// long chains of clear interfaces what is ended comes back as noise that costs more than the steps that are saved.
/// With 4 a picture of glasses had half of the variance times time that it had with 1, one of an hourglass 0.82 of it;
/// with 16 it was 0.49 and 0.85. At least a twentieth of the paths survive, so that no weight grows by more than 20 at
/// once; where nearly all would, all do.
inline float roulette_survival(float worth, int depth) {
    constexpr int depth_without_roulette = 3;
    constexpr float survival_per_worth = 4.0f, least = 0.05f, nearly_certain = 0.95f;
    const float survival = std::max(survival_per_worth * worth, least);
    return depth > depth_without_roulette && survival < nearly_certain ? survival : 1.0f;
}

}  // namespace phasetree::tracer
