#include "media/varying.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace phasetree::tracer {

namespace {

// After so many collisions the rest of a way counts as empty. It ends ways without end through a field without bounds,
// and those that are longer than so many mean free paths of the densest place.
constexpr int most_collisions = 1 << 16;

// A passage has at least this many tentative collisions on average. Eight are evaluated in the time of one, and more of
// them estimate what is left and what shines with less noise.
constexpr float collisions_of_passage = 5;

// The part of a way within a box: from the first distance to the second, which is not greater if there is none.
std::pair<float, float> within(const Bounds& box, const Way& way) {
    float from = 0.0f, to = way.length;
    for (int i = 0; i < 3; ++i) {
        if (way.direction[i] == 0.0f) {
            if (!(way.origin[i] >= box.low[i] && way.origin[i] <= box.high[i])) return {0.0f, 0.0f};
            continue;
        }
        const float a = (box.low[i] - way.origin[i]) / way.direction[i];
        const float b = (box.high[i] - way.origin[i]) / way.direction[i];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return {from, to};
}

}  // namespace

VaryingMedium::VaryingMedium(const ScatteringCoefficients& coefficients, const Density& density)
    : coefficients_(coefficients), density_(density) {
    majorant_ = coefficients.greatest_extinction();
}

// Calls visit(distance, density, rate) until it returns false. `rate` is that of collisions per unit of length: at
// least the majorant, and high enough for `least` collisions on average within the bounds. The points of eight
// collisions are evaluated together.
template <class Visit>
void VaryingMedium::for_each_tentative_collision(const Way& way, Sampler& sampler, float least, Visit&& visit) const {
    const auto [from, to] = within(density_.bounds(), way);
    if (!(majorant_ > 0.0f) || !(from < to)) return;
    const float length = to - from, rate = std::max(majorant_, std::min(least / length, 1e30f));
    // It is counted from where the bounds begin: far away, steps may be less than floats resolve.
    float gone = 0.0f;
    for (int collisions = 0; collisions < most_collisions;) {
        BatchOfFloats at;
        std::size_t count = 0;
        while (count < batch_size && gone < length) {
            gone -= std::log1p(-sampler.next()) / rate;
            if (gone < length) at[count++] = from + gone;
        }
        if (count == 0) return;
        for (std::size_t i = count; i < batch_size; ++i) at[i] = at[0];
        const BatchOfFloats density = density_.along(way.origin, way.direction, at);
        for (std::size_t i = 0; i < count; ++i)
            if (!visit(at[i], density[i], rate)) return;
        collisions += static_cast<int>(count);
    }
}

Passage VaryingMedium::pass(const Way& way, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    const glm::vec3 extinction = coefficients.extinction();
    Passage passage;
    for_each_tentative_collision(way, sampler, collisions_of_passage, [&](float, float density, float rate) {
        passage.emitted += passage.left * coefficients.emission * (density / rate);
        passage.left *= 1.0f - extinction * (density / rate);
        return passage.left != glm::vec3(0.0f);
    });
    return passage;
}

Flight VaryingMedium::fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    Flight flight;
    for_each_tentative_collision(way, sampler, 0.0f, [&](float distance, float density, float) {
        const glm::vec3 scattering = coefficients.scattering * density;
        const glm::vec3 null = glm::max(majorant_ - coefficients.extinction() * density, glm::vec3(0.0f));
        flight.emitted += flight.weight * coefficients.emission * (density / majorant_);
        const glm::vec3 history = throughput * flight.weight;
        const float scattered = glm::dot(history, scattering), going_on = glm::dot(history, null);
        if (!(scattered + going_on > 0.0f)) {
            flight.weight = glm::vec3(0.0f);  // all is absorbed
            return false;
        }
        const float probability = scattered / (scattered + going_on);
        if (scattered > 0.0f && sampler.next() < probability) {
            flight.weight *= scattering / (majorant_ * probability);
            flight.scattered_at = distance;
            return false;
        }
        flight.weight *= null / (majorant_ * (1.0f - probability));
        return true;
    });
    return flight;
}

}  // namespace phasetree::tracer
