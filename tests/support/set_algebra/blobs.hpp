#pragma once

/// Fields of other models: a sum of skeletons, a network.

#include "support/random_tree.hpp"
#include "support/set_algebra/primitives.hpp"

namespace phasetree::tests::oracle {

/// The distance to each skeleton: the points, the chain, the fields.
inline std::vector<double> skeletons(const Blob& n, const dvec3& p) {
    std::vector<double> d;
    for (const glm::vec3& v : n.points) d.push_back(glm::length(p - dvec3(v)));
    if (!n.polyline.empty()) {
        double nearest = absent;
        for (std::size_t i = 0; i + 1 < n.polyline.size(); ++i) {
            const dvec3 a(n.polyline[i]), b(n.polyline[i + 1]);
            nearest = std::min(nearest, a == b ? glm::length(p - a) : to_edge(p, a, b));
        }
        d.push_back(nearest);
    }
    for (const Field& f : n.of) d.push_back(std::max(value(f, p), 0.0));
    return d;
}
template <class List>
double entry(const List& list, std::size_t i) {
    return list.empty() ? 1 : list[list.size() == 1 ? 0 : i];
}
inline double contributions(const Blob& n, const dvec3& p) {
    const std::vector<double> d = skeletons(n, p);
    double sum = 0;
    for (std::size_t i = 0; i < d.size(); ++i)
        if (const double x = d[i] / entry(n.radii, i); x < 1) sum += entry(n.weights, i) * std::pow(1 - x * x, 3);
    return sum;
}
inline bool member(const Blob& n, const dvec3& p) {
    return contributions(n, p) > n.threshold;
}
/// The field, or the distance to where a single skeleton contributes its share of the threshold.
inline double signed_value(const Blob& n, const dvec3& p) {
    const std::vector<double> d = skeletons(n, p);
    double weights = 0, outside = absent;
    for (std::size_t i = 0; i < d.size(); ++i) weights += entry(n.weights, i);
    const double x = std::sqrt(1 - std::cbrt(n.threshold / weights));
    for (std::size_t i = 0; i < d.size(); ++i)
        outside = std::min(
            outside, (n.of.empty() || i + n.of.size() < d.size() ? d[i] : value(n.of[i + n.of.size() - d.size()], p)) -
                         x * entry(n.radii, i));
    return std::max((n.threshold - contributions(n, p)) / n.slope, outside);
}

inline double signed_value(const Siren& n, const dvec3& p) {
    const SirenNetwork& network = *n.file.content;
    const dvec3 q = glm::clamp(p, dvec3(-network.radius), dvec3(network.radius));
    std::vector<double> x{q.x, q.y, q.z};
    for (const SirenNetwork::Layer& layer : network.layers) {
        std::vector<double> y(layer.bias.begin(), layer.bias.end());
        for (std::size_t o = 0; o < y.size(); ++o) {
            for (std::size_t i = 0; i < x.size(); ++i) y[o] += layer.weights[o * x.size() + i] * x[i];
            if (&layer != &network.layers.back()) y[o] = std::sin(y[o]);
        }
        x = y;
    }
    return std::max(x[0] / n.lipschitz, glm::length(p) - network.radius);
}
inline bool member(const Siren& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

}  // namespace phasetree::tests::oracle

namespace phasetree::tests {

inline SirenNetwork random_content(Random& rng, std::type_identity<SirenNetwork>) {
    SirenNetwork network;
    network.radius = rng.uniform(0.5f, 1.2f);
    for (const auto& [inputs, outputs] : {std::pair(3, 7), std::pair(7, 5), std::pair(5, 1)}) {
        SirenNetwork::Layer layer{inputs, outputs, {}, {}};
        for (int i = 0; i < inputs * outputs; ++i) layer.weights.push_back(rng.uniform(-0.9f, 0.9f));
        for (int o = 0; o < outputs; ++o) layer.bias.push_back(rng.uniform(-0.9f, 0.5f));
        network.layers.push_back(std::move(layer));
    }
    return network;
}

}  // namespace phasetree::tests
