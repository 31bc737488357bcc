#pragma once

/// Lists of balls, one by one.

#include "phasetree/nodes/phased/particles.hpp"
#include "support/random_number.hpp"
#include "support/set_algebra/components.hpp"

namespace phasetree::tests::oracle {

/// Calls f(number, distance) for each ball.
template <class Node, class F>
void for_each_ball(const Node& n, const dvec3& p, F&& f) {
    const BallList* file = n.file.content.get();
    const std::vector<glm::vec3>& centres = file ? file->centres : n.centres;
    const std::vector<float>& radii = file && !file->radii.empty() ? file->radii : n.radii;
    for (std::size_t i = 0; i < centres.size(); ++i)
        f(i, glm::length(p - dvec3(centres[i])) - static_cast<double>(radii[radii.size() == 1 ? 0 : i]));
}
inline double signed_value(const Balls& n, const dvec3& p) {
    double least = absent;
    for_each_ball(n, p, [&](std::size_t, double distance) { least = std::min(least, distance); });
    return least;
}
inline bool member(const Balls& n, const dvec3& p) {
    bool is_in_any = false;
    for_each_ball(n, p, [&](std::size_t, double distance) { is_in_any = is_in_any || distance < 0; });
    return is_in_any;
}

inline Phase phase_of_ball(const Particles& n, std::size_t ball) {
    if (n.of_phases.size() == 1) return n.of_phases[0];
    return n.of_phases[n.file.content ? n.file.content->phases[ball] : ball];
}
inline Phase region(const Particles& n, const dvec3& p) {
    Phase owner = vacuum;
    double least = 0;
    for_each_ball(n, p, [&](std::size_t i, double distance) {
        if (!(distance < least)) return;
        least = distance;
        owner = phase_of_ball(n, i);
    });
    return owner;
}
inline Components components(const Particles& n, const dvec3& p) {
    Components distance, r;
    double least = absent;
    for_each_ball(n, p, [&](std::size_t i, double d) {
        double& of_phase = distance[phase_of_ball(n, i).index];
        of_phase = std::min(of_phase, d);
        least = std::min(least, d);
    });
    for (std::size_t k = 1; k < Components::size; ++k) {
        if (!(distance[k] < absent)) continue;
        r[k] = distance[k];
        for (std::size_t m = 1; m < Components::size; ++m)
            if (m != k && distance[m] < absent) r[k] = std::max(r[k], (distance[k] - distance[m]) / 2);
    }
    r[0] = -least;
    return r;
}

}  // namespace phasetree::tests::oracle

namespace phasetree::tests {

inline BallList random_content(Random& rng, std::type_identity<BallList>) {
    BallList list;
    const bool has_radii = rng.chance(0.7), has_phases = rng.chance(0.7);
    const auto coordinate = [&] { return detail::random_number(rng, {"", "m", ""}); };
    for (int left = 1 + rng.below(rng.chance(0.3) ? 60 : 6); left > 0; --left) {
        list.centres.emplace_back(coordinate(), coordinate(), coordinate());
        if (has_radii) list.radii.push_back(rng.chance(0.3) ? 0.25f : rng.uniform(0.05f, 0.4f));
        if (has_phases) list.phases.push_back(static_cast<std::uint8_t>(rng.below(2)));
    }
    return list;
}

}  // namespace phasetree::tests
