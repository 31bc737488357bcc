#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/profile.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"
#include "phasetree/nodes/fields/sphere.hpp"

namespace phasetree {

/// A neural field, divided by a bound λ of its slope. Outside the ball in which it was trained, its values are
/// arbitrary. There the distance to the ball takes over, which is larger anyway because f/λ is small. So max(|p| − R,
/// f/λ) is the intersection of both. It is 1-Lipschitz, and the network need not be evaluated where the ball alone
/// determines the result.
struct Siren {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"siren", "7.5, 9.4", "max(|p| − R, f(p)/λ),  λ = Π ‖Wᵢ‖₂",
                                   "A neural field with sinusoidal layers, from a file of weights."};
    /// The primitive f/λ. Points outside the cube around the ball are projected onto it, which never increases
    /// distances.
    struct Network {
        std::vector<float> values{};

        std::span<const float> data() const { return values; }
        static constexpr bool is_best_in_small_boxes = true;  ///< expensive, with much better bounds in small boxes
        /// Encloses the values in a box inside the cube by Taylor polynomials.
        static std::optional<enclosure::Enclosure> enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                            const std::array<double, 3>& half);
        static unsigned half_instructions(const float* data) {
            return static_cast<unsigned>(multiplications(data)) / 3;
        }
        /// The number of multiplications per evaluation, which dominate its cost.
        static float multiplications(const float* data) {
            float sum = 0;
            const float* at = data + 2;
            for (int layer = 0; layer < static_cast<int>(data[0]); ++layer) {
                sum += at[0] * at[1];
                at += 2 + static_cast<std::size_t>((at[0] + 1) * at[1]);
            }
            return sum;
        }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p) {
            const int layers = static_cast<int>(data[0]);
            const float radius = data[1];
            const float* at = data + 2;
            std::array<T, SirenNetwork::widest> now, next;
            now[0] = clamp(p.x, T(-radius), T(radius));
            now[1] = clamp(p.y, T(-radius), T(radius));
            now[2] = clamp(p.z, T(-radius), T(radius));
            for (int layer = 0; layer < layers; ++layer) {
                const auto inputs = static_cast<std::size_t>(at[0]), outputs = static_cast<std::size_t>(at[1]);
                const float *weight = at + 2, *bias = weight + inputs * outputs;
                const auto activated = [&](const T& sum) { return layer + 1 < layers ? sine(sum) : sum; };
                // Four sums are computed at a time, because a single one would wait for each of its additions.
                std::size_t o = 0;
                for (; o + 4 <= outputs; o += 4, weight += 4 * inputs) {
                    T a(bias[o]), b(bias[o + 1]), c(bias[o + 2]), d(bias[o + 3]);
                    for (std::size_t i = 0; i < inputs; ++i) {
                        const T& x = now[i];
                        a = a + x * weight[i];
                        b = b + x * weight[inputs + i];
                        c = c + x * weight[2 * inputs + i];
                        d = d + x * weight[3 * inputs + i];
                    }
                    next[o] = activated(a);
                    next[o + 1] = activated(b);
                    next[o + 2] = activated(c);
                    next[o + 3] = activated(d);
                }
                for (; o < outputs; ++o, weight += inputs) {
                    T sum(bias[o]);
                    for (std::size_t i = 0; i < inputs; ++i) sum = sum + now[i] * weight[i];
                    next[o] = activated(sum);
                }
                for (o = 0; o < outputs; ++o) now[o] = next[o];
                at = bias + outputs;
            }
            return now[0];
        }
    };
    using Parts = TypeList<Network>;

    FromFile<SirenNetwork> file{};
    int samples = 0;
    Network network{};    ///< derived
    float lipschitz = 1;  ///< λ, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Siren::file, Parameter{"file", "",
                                  "File of weights: JSON, {\"radius\": R, \"layers\": [{\"weights\": [[…], …], "
                                  "\"bias\": […]}, …]}, with the frequencies multiplied in."});
        v(&Siren::samples,
          Parameter{"samples",
                    "",
                    "0: λ is the product of the layers' spectral norms, a proven bound on the slope. n > 0: λ is 1.1 "
                    "times the steepest slope found at n points, which is tighter and faster, but not proven.",
                    {.low = 0, .high = 10'000'000},
                    true});
    }
    void prepare() {
        if (const char* mistake = file.content->mistake()) throw ModelError(std::string("siren: ") + mistake);
        const double slope = samples > 0 ? file.content->sampled_slope(samples) : file.content->spectral_bound();
        if (!(slope > 1e-6 && slope < 1e9)) throw ModelError("siren: the network is too steep or too flat");
        lipschitz = static_cast<float>(slope);
        network.values = file.content->table(static_cast<float>(1 / slope));
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return max(d.primitive(Sphere{.radius = file.content->radius}, p), d.primitive(network, p));
    }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const { return network.data().size_bytes(); }
    Bounds bounds(BoundsQuery& q, float level) const {
        const float r = file.content->radius + level;
        if (r < 0) return {};
        return q.placed(Bounds::centred(glm::vec3(r)),
                        [&](const glm::dvec3& d) { return glm::length(d) * static_cast<double>(r); });
    }
};

}  // namespace phasetree
