#pragma once

/// Walks in double precision against what is known of a ray without φ.
///
/// A walk and its oracle are step functions of the distance t along the ray: the phase at each t. The oracle's comes
/// from analytic roots and Boolean set algebra in double precision (support/analytic_roots.hpp). Where the two differ
/// over a stretch of the ray that is longer and deeper than is allowed, a crossing was lost, invented, found twice or
/// has wrong phases.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "phasetree/trace/precise_tracer.hpp"
#include "support/analytic_roots.hpp"
#include "support/set_algebra.hpp"
#include "support/traced_scenes.hpp"

namespace phasetree::tests::walks {

using analytic::Piece;
using glm::dvec3;
using traced::filled, traced::moved, traced::phase, traced::Scene;

// Scenes whose constants are the same in the program and in the oracle to the last bit: no rotations and scales, which
// floats round. Half of the sizes and places are multiples of a quarter, so that faces coincide.
inline Field exact_solid(Random& rng) {
    const auto size = [&](float low, float high) {
        const float v = rng.uniform(low, high);
        return rng.chance(0.5) ? std::max(std::round(v * 4) / 4, 0.25f) : v;
    };
    const float a = size(0.1f, 0.8f), b = size(0.1f, 0.8f), c = size(0.1f, 0.8f);
    switch (rng.below(7)) {
        case 0:
        case 1:
            return Sphere{.radius = a};
        case 2: {  // a wall, 6·10⁻⁸ to 4·10⁻³ thick
            Box wall{.size = {2 * a, 2 * b, 2 * c}};
            wall.size[rng.below(3)] = std::exp2(-rng.uniform(8, 24));
            return wall;
        }
        case 3:
        case 4:
            return Box{.size = {2 * a, 2 * b, 2 * c}};
        default:
            return Cylinder{.radius = a, .height = 2 * b};
    }
}
inline Field exact_placed(Random& rng) {
    glm::vec3 by = rng.in(Bounds::centred(glm::vec3(0.8f)));
    if (rng.chance(0.5)) by = glm::round(4.f * by) / 4.f;
    return moved(by, exact_solid(rng));
}
inline Scene exact_scene(Random& rng) {
    std::vector<Phased> solids;
    const int n = 2 + rng.below(6);
    for (int i = 0; i < n; ++i) {
        Field f = exact_placed(rng);
        if (rng.chance(0.3)) f = Difference{.from = f, .subtract = {exact_placed(rng)}};
        if (rng.chance(0.2)) f = Intersection{.of = {f, exact_placed(rng)}};
        solids.push_back(filled(1 + rng.below(4), f));
    }
    Phased a = Under{.of = solids};
    if (rng.chance(0.3)) a = Change{.of = a, .from = phase(1), .to = phase(2), .shape = exact_placed(rng)};
    if (rng.chance(0.3)) a = SubtractShape{.of = a, .shape = exact_placed(rng), .phases_cut = PhaseSet::of(phase(3))};
    if (rng.chance(0.2)) a = Remove{.of = a, .gone = PhaseSet::of(phase(4))};
    return {"exact", a, {{0.25f, 0.25f, 0.25f}, {0.5f, 0, 0}, {-0.25f, 0.5f, 0}, {0, 0, 0}}};
}

/// How far a walk may differ from its oracle: over how long a stretch, or how deep a phase.
struct Tolerance {
    double length = 0, depth = 0;
};

struct Totals {
    std::size_t rays = 0, crossings = 0;
    std::size_t wrong = 0;        ///< stretches in the wrong phase
    std::size_t unchained = 0;    ///< crossings whose `from` is not `to` of the one before, or that go back
    std::size_t uncertified = 0;  ///< crossings whose ends do not have their phases
    std::size_t wide = 0;         ///< brackets longer than a few units in the last place
    std::size_t bad_normals = 0;  ///< normals of isolated crossings that are off
    std::size_t normals = 0;      ///< normals that were compared
    std::vector<std::string> complaints{};

    std::size_t errors() const { return wrong + unchained + uncertified + wide + bad_normals; }
    void add(const Totals& t) {
        rays += t.rays;
        crossings += t.crossings;
        wrong += t.wrong;
        unchained += t.unchained;
        uncertified += t.uncertified;
        wide += t.wide;
        bad_normals += t.bad_normals;
        normals += t.normals;
        complaints.insert(complaints.end(), t.complaints.begin(), t.complaints.end());
    }
    void complain(const std::string& what, const dvec3& o, const dvec3& d) {
        if (complaints.size() >= 10) return;
        std::ostringstream s;
        s.precision(17);
        s << what << ": o = (" << o.x << ", " << o.y << ", " << o.z << ") d = (" << d.x << ", " << d.y << ", " << d.z
          << ")";
        complaints.push_back(s.str());
    }
};

/// A walk: the phase at its start, and its crossings, at distances from the origin of the ray.
struct Walk {
    Phase start;
    std::vector<PreciseCrossing> crossings;

    Phase at(double t) const {
        Phase phase = start;
        for (const PreciseCrossing& c : crossings)
            if (c.t_to <= t) phase = c.to;
        return phase;
    }
};

/// All crossings along rays in one call.
inline std::vector<Walk> walked(const PreciseTracer& tracer, std::span<const PreciseRay> rays) {
    const auto found = tracer.crossings(rays);
    std::vector<Walk> walks(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
        walks[i] = {found->start[i],
                    {found->crossings.begin() + static_cast<std::ptrdiff_t>(found->offsets[i]),
                     found->crossings.begin() + static_cast<std::ptrdiff_t>(found->offsets[i + 1])}};
    return walks;
}
inline Walk walked(const PreciseTracer& tracer, const PreciseRay& ray) {
    return walked(tracer, std::span(&ray, 1)).front();
}

/// The same, with one search per crossing, each from the far end of the previous one.
inline std::vector<Walk> restarted(const PreciseTracer& tracer, std::span<const PreciseRay> rays) {
    std::vector<Walk> walks(rays.size());
    std::vector<PreciseRay> going(rays.begin(), rays.end());
    std::vector<std::size_t> number(rays.size());  // of the rays that continue
    std::vector<double> behind(rays.size(), 0.0);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        number[i] = i;
        walks[i].start = tracer.evaluator().label(rays[i].origin);
        if (!tracer.bounds().contains(glm::vec3(rays[i].origin))) walks[i].start = vacuum;
        if (rays[i].carried) walks[i].start = *rays[i].carried;
    }
    std::vector<std::optional<PreciseCrossing>> found;
    for (int count = 0; !going.empty() && count < 100'000; ++count) {
        found.assign(going.size(), std::nullopt);
        tracer.first_crossings(going, found);
        std::size_t left = 0;
        for (std::size_t k = 0; k < going.size(); ++k) {
            if (!found[k]) continue;
            PreciseCrossing c = *found[k];
            const std::size_t i = number[k];
            PreciseRay ray = going[k];
            ray.origin = c.p_to;
            ray.carried = c.to;
            c.t_from += behind[i];
            c.t_to += behind[i];
            behind[i] = c.t_to;
            ray.t_max = rays[i].t_max - behind[i];
            walks[i].crossings.push_back(c);
            going[left] = ray;
            number[left++] = i;
        }
        going.resize(left);
        number.resize(left);
    }
    return walks;
}

/// Compares a walk with the exact pieces of its ray. The direction is of unit length.
inline void compare(const Phased& object, const Walk& walk, std::span<const Piece> exact, const dvec3& o,
                    const dvec3& d, double length, const Tolerance& tolerance, Totals& totals) {
    std::vector<double> breaks{0, length};
    for (const Piece& p : exact) breaks.push_back(p.start);
    for (const PreciseCrossing& c : walk.crossings) breaks.push_back(std::clamp(c.t_to, 0.0, length));
    std::sort(breaks.begin(), breaks.end());
    const auto exact_at = [&](double t) {
        std::size_t i = 0;
        while (i + 1 < exact.size() && exact[i + 1].start <= t) ++i;
        return exact[i].phase;
    };
    double since = -1;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const double low = breaks[i], high = breaks[i + 1], middle = 0.5 * (low + high);
        if (!(high > low)) continue;
        const bool is_wrong = exact_at(middle) != walk.at(middle);
        if (is_wrong && since < 0) since = low;
        if (since < 0 || (is_wrong && high < length)) continue;
        const double begin = since, end = is_wrong ? high : low;
        since = -1;
        if (end - begin <= tolerance.length) continue;
        double deepest = 0;
        for (int k = 0; k <= 64; ++k)
            deepest = std::max(deepest, values(object, o + (begin + (end - begin) * k / 64) * d).interface_distance());
        if (deepest <= tolerance.depth) continue;
        ++totals.wrong;
        std::ostringstream what;
        what.precision(17);
        what << "wrong from " << begin << " to " << end << ", " << deepest << " deep, exact phase "
             << int(exact_at(0.5 * (begin + end)).index) << ", walked " << int(walk.at(0.5 * (begin + end)).index);
        totals.complain(what.str(), o, d);
    }
}

/// What must be true of any walk: crossings chain, their ends are in their phases, and brackets are short.
inline void check_brackets(const PreciseTracer& tracer, const Walk& walk, const dvec3& o, const dvec3& d,
                           Totals& totals) {
    const Bounds& b = tracer.bounds();
    double farthest = 0;
    for (int i = 0; i < 3; ++i)
        farthest = std::max({farthest, std::abs(double{b.low[i]}), std::abs(double{b.high[i]})});
    Phase phase = walk.start;
    double t = 0;
    for (const PreciseCrossing& c : walk.crossings) {
        ++totals.crossings;
        const auto complain = [&](const char* what, std::size_t& count) {
            if (count++ >= 3) return;
            std::ostringstream text;
            text.precision(17);
            text << what << " from " << int(c.from.index) << " to " << int(c.to.index) << " at " << c.t_from << " … "
                 << c.t_to << ", " << glm::distance(c.p_from, c.p_to) << " long, with the normal (" << c.normal.x
                 << ", " << c.normal.y << ", " << c.normal.z << ")";
            totals.complain(text.str(), o, d);
        };
        if (c.from != phase || c.to == c.from || c.t_from < t - 1e-12 * farthest || c.t_to < c.t_from)
            complain("not chained", totals.unchained);
        const PreciseEvaluator& e = tracer.evaluator();
        if (e.label(c.p_to) != c.to ||
            (e.label(c.p_from) != c.from && c.t_from != c.t_to && e.component(c.p_from, c.from) > tracer.value_error()))
            complain("not certified", totals.uncertified);
        if (glm::distance(c.p_from, c.p_to) > 0x1p-48 * farthest) complain("wide bracket", totals.wide);
        // Along a face, the angle to the ray is 90° up to rounding errors.
        if (!(std::abs(glm::length(c.normal) - 1) < 1e-9 && glm::dot(c.normal, d) > -1e-14))
            complain("normal", totals.bad_normals);
        phase = c.to;
        t = c.t_to;
    }
}

/// Whether the interface that a ray crosses at p, with this normal, has no edge within a few times `reach`.
inline bool is_smooth(const Phased& object, const dvec3& p, const dvec3& n, Phase from, Phase to, double reach) {
    const dvec3 u = glm::normalize(std::abs(n.x) < 0.5 ? glm::cross(n, dvec3(1, 0, 0)) : glm::cross(n, dvec3(0, 1, 0)));
    const dvec3 v = glm::cross(n, u);
    for (const double side : {-reach, reach})
        if (values(object, p + side * n).interface_distance() < 0.75 * reach) return false;
    for (int i = 0; i < 8; ++i) {
        const dvec3 q = p + 8 * reach * (std::cos(i * 0.7853981634) * u + std::sin(i * 0.7853981634) * v);
        if (tests::label(object, q - reach * n) != from || tests::label(object, q + reach * n) != to) return false;
    }
    return true;
}

/// Compares the normals and distances of crossings far from others and from edges with those of the oracle.
inline void compare_isolated(const Phased& object, const Walk& walk, std::span<const Piece> exact, const dvec3& o,
                             const dvec3& d, double size, double tolerance, Totals& totals) {
    for (std::size_t i = 1; i < exact.size(); ++i) {
        const double t = exact[i].start, apart = 1e-3 * size;
        if (t - exact[i - 1].start < apart || (i + 1 < exact.size() && exact[i + 1].start - t < apart)) continue;
        dvec3 n = exact[i].normal;
        const double cosine = std::abs(glm::dot(n, d));
        if (cosine < 0.05) continue;
        if (glm::dot(n, d) < 0) n = -n;
        if (!is_smooth(object, o + t * d, n, exact[i - 1].phase, exact[i].phase, 1e-5 * size)) continue;
        for (const PreciseCrossing& c : walk.crossings) {
            if (std::abs(c.t_to - t) > 0.5 * apart) continue;
            // Within rounding errors of a face, the ray may be in any phase that meets there. compare() judges that.
            if (c.from != exact[i - 1].phase || c.to != exact[i].phase) continue;
            ++totals.normals;
            const double off = std::abs(c.t_to - t), most_off = tolerance / cosine;
            const double turned = glm::length(glm::cross(c.normal, n)), most_turned = 1e-6 + 1e3 * tolerance / size;
            if ((off > most_off || turned > most_turned) && totals.bad_normals++ < 3) {
                std::ostringstream text;
                text << "off by " << off << " (at most " << most_off << "), turned by " << turned << " (at most "
                     << most_turned << "), from " << int(c.from.index) << " to " << int(c.to.index) << " at t = " << t
                     << ", object of size " << size;
                totals.complain(text.str(), o, d);
            }
        }
    }
}

}  // namespace phasetree::tests::walks
