#include "media/varying.hpp"

#include <algorithm>
#include <optional>

#include "image/luminance.hpp"
#include "media/channel_choice.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

// After this many collisions, the rest of a stretch, or of the whole segment, counts as empty. This terminates infinite
// segments through an unbounded field, and those through blocks of voxels of which one is far denser than the others.
constexpr int most_collisions_of_stretch = 1 << 16, most_collisions = 1 << 20;

// Where more tentative collisions reduce the noise of estimates of transmittance and emission, a segment without empty
// stretches has at least this many on average.
constexpr float collisions_of_estimate = 5;

// Transmittance below `little` is subject to Russian roulette with this survival probability.
constexpr float little = 0.05f, survival = 0.25f;

struct Place {
    float distance, rate;
    float density_bound;
};

// The points of tentative collisions, sampled in the stretches of a density. Their rate per unit length is at least
// `extinction` times the bound on the density.
template <DensityKind D>
class Places {
  public:
    Places(const D& density, float extinction, const Way& way, float least_collisions)
        : stretches_(density.stretches(way)), extinction_(extinction) {
        if (!(stretches_.length() > 0.0f)) return;
        constexpr float most = 1e30f;  // Products with it stay finite.
        least_rate_ = std::min(least_collisions / stretches_.length(), most);
        stretch_ = stretches_.next();
    }

    // The next point; nullopt at the end of the segment.
    std::optional<Place> next(Sampler& sampler) {
        if (!stretch_) return std::nullopt;
        // The integral of the rate up to the next point. Each stretch consumes its part.
        float thickness = -portable::log1p(-sampler.next());
        for (; stretch_; begin_next_stretch()) {
            // The stretch has reached its limit. The remaining thickness is right for the next stretch, too, because an
            // exponential distribution has no memory.
            if (collisions_ >= most_collisions_of_stretch) continue;
            const float length = stretch_->to - stretch_->from;
            const float rate = std::max(extinction_ * stretch_->bound, least_rate_);
            if (gone_ + thickness / rate < length) {
                gone_ += thickness / rate;
                ++collisions_;
                return Place{stretch_->from + gone_, rate, stretch_->bound};
            }
            thickness = std::max(thickness - (length - gone_) * rate, 0.0f);
        }
        return std::nullopt;
    }

  private:
    void begin_next_stretch() {
        stretch_ = stretches_.next();
        gone_ = 0.0f;
        collisions_ = 0;
    }

    typename D::Stretches stretches_;
    float extinction_;
    float least_rate_ = 0.0f;
    std::optional<DensityStretch> stretch_{};
    // The distance is relative to the start of the stretch: far from a segment's origin, steps may be smaller than
    // floats resolve.
    float gone_ = 0.0f;
    int collisions_ = 0;  // in the stretch
};

}  // namespace

struct VaryingMedium::Collision {
    float distance, rate;
    float density;
    glm::vec3 at;

    // The contribution of this collision per unit coefficient.
    float share() const { return density / rate; }
};

VaryingMedium::VaryingMedium(const ScatteringCoefficients& coefficients, const Density& density,
                             const std::optional<Heat>& heat)
    : coefficients_(coefficients),
      density_(density),
      heat_(heat),
      greatest_extinction_(coefficients.greatest_extinction()),
      luminance_(tracer::luminance(coefficients.emission)),
      emits_(coefficients.emission != glm::vec3(0.0f)) {
    if (heat_) coefficients_.emission_spectrum = heat_->spectrum();
}

BatchOfFloats VaryingMedium::brightness_at(const PointBatch& points) const {
    BatchOfFloats brightness = densities_at(points);
    if (heat_)
        for (std::size_t i = 0; i < batch_size; ++i) brightness[i] *= heat_->luminance(heat_->share_at(points[i]));
    return brightness;
}

// Calls visit(collision) for each tentative collision until it returns false.
template <class Visit>
void VaryingMedium::for_each_tentative_collision(const Way& way, Sampler& sampler, float least_collisions,
                                                 Visit&& visit) const {
    if (!(greatest_extinction_ > 0.0f)) return;
    const auto visit_those_in = [&]<DensityKind D>(const D& kind) {
        Places<D> places(kind, greatest_extinction_, way, least_collisions);
        for (int collisions = 0; collisions < most_collisions;) {
            std::array<Place, D::together> found;
            std::size_t count = 0;
            for (; count < D::together; ++count) {
                const std::optional<Place> place = places.next(sampler);
                if (!place) break;
                found[count] = *place;
            }
            if (count == 0) return;
            PointBatch points;
            for (std::size_t i = 0; i < batch_size; ++i) {
                // The unused entries of a batch repeat the first collision.
                const float distance = found[i < count ? i : 0].distance;
                points.x[i] = way.origin.x + distance * way.direction.x;
                points.y[i] = way.origin.y + distance * way.direction.y;
                points.z[i] = way.origin.z + distance * way.direction.z;
            }
            const BatchOfFloats density = kind.at(points, count);
            for (std::size_t i = 0; i < count; ++i) {
                // At the border of a stretch, the density may exceed the bound by a rounding error.
                const float bounded = std::min(density[i], found[i].density_bound);
                if (!visit(Collision{found[i].distance, found[i].rate, bounded, points[i]})) return;
            }
            collisions += static_cast<int>(count);
        }
    };
    std::visit(visit_those_in, density_);
}

glm::vec3 VaryingMedium::emitted_at(const Collision& c, const ScatteringCoefficients::ForLight& coefficients,
                                    const Wavelengths* wavelengths) const {
    if (!(c.density > 0.0f)) return glm::vec3(0.0f);
    if (!heat_) return coefficients.emission * c.share();
    return heat_->light(heat_->share_at(c.at), luminance_, wavelengths) * c.share();
}

Passage VaryingMedium::pass(const Way& way, bool with_emission, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    const glm::vec3 extinction = coefficients.extinction();
    Passage passage;
    for_each_tentative_collision(way, sampler, collisions_of_estimate, [&](const Collision& c) {
        if (with_emission) passage.emitted += passage.left * emitted_at(c, coefficients, way.wavelengths);
        passage.left *= glm::max(1.0f - extinction * c.share(), glm::vec3(0.0f));
        if (std::max({passage.left.x, passage.left.y, passage.left.z}) < little) {
            if (sampler.next() < survival)
                passage.left /= survival;
            else
                passage.left = glm::vec3(0.0f);
        }
        return passage.left != glm::vec3(0.0f);
    });
    return passage;
}

Flight VaryingMedium::fly(const Way& way, const glm::vec3& throughput, Sampler& sampler) const {
    const auto coefficients = coefficients_.for_light(way.wavelengths);
    Flight flight;
    const float least_collisions = emits_ ? collisions_of_estimate : 0.0f;
    for_each_tentative_collision(way, sampler, least_collisions, [&](const Collision& c) {
        const glm::vec3 scattering = coefficients.scattering * c.density;
        const glm::vec3 null = glm::max(c.rate - coefficients.extinction() * c.density, glm::vec3(0.0f));
        if (emits_) flight.emitted += flight.weight * emitted_at(c, coefficients, way.wavelengths);
        const glm::vec3 choice = channel_choice(throughput * flight.weight);
        const float scattered = glm::dot(choice, scattering), going_on = glm::dot(choice, null);
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
