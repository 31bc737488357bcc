#include "media/varying.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "image/luminance.hpp"

namespace phasetree::tracer {

namespace {

// After so many collisions the rest of a stretch counts as empty, and after so many in all the rest of a way. That ends
// ways without end through a field without bounds, and those through blocks of voxels of which one is far denser than
// the others.
constexpr int most_collisions_of_stretch = 1 << 16, most_collisions = 1 << 20;

// A passage has at least this many tentative collisions on average. Eight are evaluated in the time of one, and more of
// them estimate what is left and what shines with less noise.
constexpr float collisions_of_passage = 5;

// The places at which a way may meet something, sampled in the stretches of a density. The rate of these tentative
// collisions, per unit of length, is at least `extinction` times the bound on the density, and high enough for `least`
// collisions on average on a way that may meet something everywhere.
template <DensityKind D>
class TentativeCollisions {
  public:
    TentativeCollisions(const D& density, float extinction, const Way& way, float least)
        : stretches_(density.stretches(way)), extinction_(extinction) {
        if (!(stretches_.length() > 0.0f)) return;
        least_rate_ = std::min(least / stretches_.length(), 1e30f);
        stretch_ = stretches_.next();
    }

    // The next one's distance and rate, and the bound on the density there; nothing at the way's end.
    struct Next {
        float distance, rate, greatest;
    };
    std::optional<Next> next(Sampler& sampler) {
        if (!stretch_) return std::nullopt;
        // So much is gone through before it: the integral of the rate.
        float thickness = -std::log1p(-sampler.next());
        for (; stretch_; begin_next()) {
            if (collisions_ >= most_collisions_of_stretch) continue;
            const float length = stretch_->to - stretch_->from;
            const float rate = std::max(extinction_ * stretch_->greatest, least_rate_);
            if (gone_ + thickness / rate < length) {
                gone_ += thickness / rate;
                ++collisions_;
                return Next{stretch_->from + gone_, rate, stretch_->greatest};
            }
            thickness = std::max(thickness - (length - gone_) * rate, 0.0f);
        }
        return std::nullopt;
    }

  private:
    void begin_next() {
        stretch_ = stretches_.next();
        gone_ = 0.0f;
        collisions_ = 0;
    }

    typename D::Stretches stretches_;
    float extinction_;
    float least_rate_ = 0.0f;
    std::optional<DensityStretch> stretch_{};
    // It is counted from where the stretch begins: far away, steps may be less than floats resolve.
    float gone_ = 0.0f;
    int collisions_ = 0;  // in the stretch
};

}  // namespace

VaryingMedium::VaryingMedium(const ScatteringCoefficients& coefficients, const Density& density,
                             const std::optional<Heat>& heat)
    : coefficients_(coefficients),
      density_(density),
      heat_(heat),
      greatest_extinction_(coefficients.greatest_extinction()),
      luminance_(tracer::luminance(coefficients.emission)) {}

BatchOfFloats VaryingMedium::brightness_at(const BatchOfFloats& x, const BatchOfFloats& y,
                                           const BatchOfFloats& z) const {
    BatchOfFloats brightness = density_at(density_, x, y, z);
    if (!heat_) return brightness;
    const BatchOfFloats shares = heat_->shares_at(x, y, z);
    for (std::size_t i = 0; i < batch_size; ++i) brightness[i] *= heat_->luminance(shares[i]);
    return brightness;
}

// Calls visit(collision) for each until it returns false. Eight are evaluated together.
template <class Visit>
void VaryingMedium::for_each_tentative_collision(const Way& way, Sampler& sampler, float least, Visit&& visit) const {
    if (!(greatest_extinction_ > 0.0f)) return;
    const auto visit_those_of = [&]<DensityKind D>(const D& kind) {
        TentativeCollisions<D> tentative(kind, greatest_extinction_, way, least);
        for (int collisions = 0; collisions < most_collisions;) {
            BatchOfFloats at, rate, greatest;
            std::size_t count = 0;
            while (count < batch_size) {
                const auto collision = tentative.next(sampler);
                if (!collision) break;
                at[count] = collision->distance;
                rate[count] = collision->rate;
                greatest[count++] = collision->greatest;
            }
            if (count == 0) return;
            for (std::size_t i = count; i < batch_size; ++i) at[i] = at[0];
            const PointsOfWay points = points_along(way, at);
            const BatchOfFloats density = kind.at(points.x, points.y, points.z);
            BatchOfFloats heat;
            if (heat_) heat = heat_->shares_at(points.x, points.y, points.z);
            for (std::size_t i = 0; i < count; ++i)
                // At the border of a stretch the density may be above the bound by a rounding error.
                if (!visit(Collision{at[i], std::min(density[i], greatest[i]), rate[i], heat_ ? heat[i] : 1.0f}))
                    return;
            collisions += static_cast<int>(count);
        }
    };
    std::visit(visit_those_of, density_);
}

Passage VaryingMedium::pass(const Way& way, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    const glm::vec3 extinction = coefficients.extinction();
    Passage passage;
    for_each_tentative_collision(way, sampler, collisions_of_passage, [&](const Collision& c) {
        passage.emitted += passage.left * emission(coefficients, c.heat, way) * (c.density / c.rate);
        passage.left *= 1.0f - extinction * (c.density / c.rate);
        return passage.left != glm::vec3(0.0f);
    });
    return passage;
}

Flight VaryingMedium::fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    Flight flight;
    for_each_tentative_collision(way, sampler, 0.0f, [&](const Collision& c) {
        const glm::vec3 scattering = coefficients.scattering * c.density;
        const glm::vec3 null = glm::max(c.rate - coefficients.extinction() * c.density, glm::vec3(0.0f));
        flight.emitted += flight.weight * emission(coefficients, c.heat, way) * (c.density / c.rate);
        const glm::vec3 history = throughput * flight.weight;
        const float scattered = glm::dot(history, scattering), going_on = glm::dot(history, null);
        if (!(scattered + going_on > 0.0f)) {
            flight.weight = glm::vec3(0.0f);  // all is absorbed
            return false;
        }
        const float probability = scattered / (scattered + going_on);
        if (scattered > 0.0f && sampler.next() < probability) {
            flight.weight *= scattering / (c.rate * probability);
            flight.scattered_at = c.distance;
            return false;
        }
        flight.weight *= null / (c.rate * (1.0f - probability));
        return true;
    });
    return flight;
}

}  // namespace phasetree::tracer
