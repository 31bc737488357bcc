#pragma once

/// Compares tracing with analytic roots: no interface may be missed or invented, and each must be in the right place.
///
/// The exact sequence of phases along a ray comes from support/analytic_roots.hpp. The tracer's sequence comes from
/// repeated calls of first_crossing(): each ray starts at p_to of the previous crossing, in the phase entered there.
///
/// Both are step functions of t. Where they differ over a stretch of the ray, the tracer is wrong, with two exceptions.
/// The stretch may be shorter than four resolutions, because this is all that tracing promises. Or all of it may be
/// within one resolution of an interface (a grazing ray, a ray within a face), where rounding decides labels. The same
/// rules apply to rays that creep along an interface for long.
///
/// Each ray's origin is the last one's p_to, rounded to floats. This displaces a ray that flickers along a face a
/// thousand times, always in one direction if its steps are shorter than an ulp of a coordinate. From there on, a
/// parallel ray is traced. It is compared with the exact ray with a tolerance of the distance between them.

#include <doctest/doctest.h>

#include <sstream>

#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/analytic_roots.hpp"
#include "support/set_algebra.hpp"
#include "support/traced_scenes.hpp"

/// A tracer under test has a type Hit, which is a Crossing, and
///     std::optional<Hit> first_crossing(origin, direction, length, carried, const Hit* start, counters)
///         `start`: the hit whose p_from or p_to the ray starts from, if it does
///     glm::vec3 normal(hit, direction), Phase label(point), Bounds bounds(), float resolution()
namespace phasetree::tests::traced {

using analytic::exact_pieces;
using analytic::Piece;
using glm::dvec3;

struct Totals {
    std::size_t rays = 0, crossings = 0, wrong = 0, uncertified = 0, rounded = 0, wide = 0, over_sliver = 0,
                misplaced = 0, bad_normals = 0;
    std::size_t creeping = 0, most_crossings = 0, flickering = 0;
    std::size_t normals = 0, reflections = 0, self_hits = 0, departures = 0, strayed = 0, batches_knowing = 0,
                batches_unknowing = 0;
    std::uint64_t max_batches = 0;
};

inline std::string report(const char* what, const Scene& scene, const Probe& probe, int n) {
    std::ostringstream s;
    s.precision(9);
    s << what << ": scene " << scene.name << ", ray " << n << " (" << probe.kind << ") o = (" << probe.o.x << ", "
      << probe.o.y << ", " << probe.o.z << ") d = (" << probe.d.x << ", " << probe.d.y << ", " << probe.d.z << ")";
    return s.str();
}

/// The direction in which a component increases, from differences in double over a hundredth of a resolution.
inline dvec3 growth(const Phased& object, const dvec3& p, Phase phase, double resolution) {
    const double step = 0.01 * resolution;
    dvec3 g;
    for (int i = 0; i < 3; ++i) {
        dvec3 side(0);
        side[i] = step;
        g[i] = values(object, p + side)[phase.index] - values(object, p - side)[phase.index];
    }
    return glm::length(g) > 0 ? glm::normalize(g) : g;
}

/// Whether an interface in the plane with this normal passes here, without an edge nearby, and without a seam, where
/// solids of one phase meet beneath the surface. At a seam, the nearest zero of φ may be that of the seam.
inline bool is_smooth(const Phased& object, const dvec3& p, const dvec3& n, Phase from, Phase to, double resolution) {
    const dvec3 u = glm::normalize(std::abs(n.x) < 0.5 ? glm::cross(n, dvec3(1, 0, 0)) : glm::cross(n, dvec3(0, 1, 0)));
    const dvec3 v = glm::cross(n, u);
    for (const double side : {-4 * resolution, 4 * resolution})
        if (values(object, p + side * n).interface_distance() < 3 * resolution) return false;
    for (int i = 0; i < 8; ++i) {
        const dvec3 q = p + 40 * resolution * (std::cos(i * 0.7853981634) * u + std::sin(i * 0.7853981634) * v);
        if (tests::label(object, q - 4 * resolution * n) != from || tests::label(object, q + 4 * resolution * n) != to)
            return false;
    }
    return true;
}

/// Whether a point, or one up to four units in the last place beside it, is in a phase.
template <class Tracer>
bool is_within_rounding(const Tracer& tracer, const glm::vec3& p, Phase phase) {
    if (tracer.label(p) == phase) return true;
    const float unit = 0x1p-23f * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    for (int axis = 0; axis < 3; ++axis)
        for (int k = -4; k <= 4; ++k) {
            glm::vec3 q = p;
            q[axis] += static_cast<float>(k) * unit;
            if (tracer.label(q) == phase) return true;
        }
    return false;
}

/// Checks one ray: counts its crossings in `totals`, and describes what a person should inspect in `complaints`.
template <class Tracer>
class RayCheck {
  public:
    RayCheck(const Scene& scene, const Tracer& tracer, const Probe& probe, int number, Totals& totals,
             std::vector<std::string>& complaints)
        : scene_(scene), tracer_(tracer), probe_(probe), number_(number), totals_(totals), complaints_(complaints) {}

    void operator()() {
        trace();
        compare_labels();
        check_isolated_crossings();
    }

  private:
    using Hit = typename Tracer::Hit;
    struct Step {
        double t_from, t_to;
        Hit crossing;
        double aside;  ///< distance from the exact ray at which it was searched for
        bool is_rounded;
    };

    void complain(const char* what) {
        if (complaints_.size() < 10) complaints_.push_back(report(what, scene_, probe_, number_));
    }

    /// Checks the tracer's crossings: each leads from the carried phase to another, and is as short as required.
    void trace() {
        Phase carried = first_;
        glm::vec3 origin = probe_.o;
        ++totals_.rays;
        for (int n = 0; n < 200'000; ++n) {  // along all of a face at five resolutions a step
            TraceCounters counters;
            const std::optional<Hit> hit = tracer_.first_crossing(
                origin, probe_.d, length_, carried, steps_.empty() ? nullptr : &steps_.back().crossing, counters);
            creeps_ = creeps_ || counters.batches > 256;
            totals_.max_batches = std::max(totals_.max_batches, counters.batches);
            if (!hit) break;
            steps_.push_back(
                {glm::dot(dvec3(hit->p_from) - o_, d_), glm::dot(dvec3(hit->p_to) - o_, d_), *hit, aside_, false});
            ++totals_.crossings;
            const bool certified = hit->from == carried && hit->from != hit->to &&
                                   tracer_.label(hit->p_to) == hit->to &&
                                   (tracer_.label(hit->p_from) == hit->from || (hit->t_from == 0 && hit->t_to == 0));
            // Along a face at an angle of 10⁻⁵, labels depend on rounding over a long distance.
            const bool is_rounded = !certified && hit->from == carried && hit->from != hit->to &&
                                    is_within_rounding(tracer_, hit->p_from, hit->from) &&
                                    is_within_rounding(tracer_, hit->p_to, hit->to);
            totals_.rounded += is_rounded;
            steps_.back().is_rounded = is_rounded;
            if (!certified && !is_rounded && totals_.uncertified++ < 3) complain("not certified");
            const double width = glm::length(dvec3(hit->p_to) - dvec3(hit->p_from));
            // A bracket is at most a resolution long, apart from rounding its ends to float coordinates. A bracket
            // across a sliver of a third phase, which may stay undecided for 1.5 resolutions, is that much longer.
            totals_.over_sliver += width > 1.01 * resolution_ + 1e-6 * glm::length(dvec3(hit->p_from));
            if (width > 2.75 * resolution_ + 1e-6 * glm::length(dvec3(hit->p_from)) && totals_.wide++ < 3)
                complain("wide bracket");
            carried = hit->to;
            origin = hit->p_to;
            aside_ = std::max(aside_, glm::length(glm::cross(dvec3(origin) - o_, d_)));
        }
        totals_.creeping += creeps_;
        totals_.most_crossings = std::max(totals_.most_crossings, steps_.size());
        totals_.flickering += steps_.size() > 100;
    }

    /// Checks where the exact step function and the tracer's differ.
    void compare_labels() {
        std::vector<double> breaks{0, length_};
        for (const Piece& p : exact_) breaks.push_back(p.start);
        for (const Step& s : steps_) breaks.push_back(0.5 * (s.t_from + s.t_to));
        std::sort(breaks.begin(), breaks.end());
        const auto exact_label = [&](double t) {
            std::size_t i = 0;
            while (i + 1 < exact_.size() && exact_[i + 1].start <= t) ++i;
            return exact_[i].phase;
        };
        const auto traced_label = [&](double t) {
            Phase l = first_;
            for (const Step& s : steps_)
                if (0.5 * (s.t_from + s.t_to) <= t) l = s.crossing.to;
            return l;
        };
        double wrong_since = -1;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            const double low = std::max(breaks[i], 0.0), high = breaks[i + 1];
            if (!(high > low)) continue;
            const double mid = 0.5 * (low + high);
            const bool wrong = exact_label(mid) != traced_label(mid);
            if (wrong && wrong_since < 0) wrong_since = low;
            const bool ends = wrong_since >= 0 && (!wrong || i + 2 == breaks.size());
            if (!ends) continue;
            const double begin = wrong_since, end = wrong ? high : low;
            wrong_since = -1;
            if (end - begin <= 4 * resolution_) continue;
            double deepest = 0;
            for (int k = 0; k <= 64; ++k)
                deepest = std::max(
                    deepest, values(scene_.object, o_ + (begin + (end - begin) * k / 64) * d_).interface_distance());
            if (deepest <= resolution_ + aside_) continue;
            if (totals_.wrong++ < 3) {
                std::ostringstream what;
                what.precision(9);
                what << "wrong from t = " << begin << " to " << end << " (" << (end - begin) / resolution_
                     << " resolutions, " << deepest / resolution_ << " deep" << (creeps_ ? ", creeping" : "")
                     << "), exact phase " << int(exact_label(0.5 * (begin + end)).index) << ", traced "
                     << int(traced_label(0.5 * (begin + end)).index);
                complain(what.str().c_str());
            }
        }
    }

    /// Checks crossings far from others: their positions, their normals, and rays reflected there.
    void check_isolated_crossings() {
        for (std::size_t i = 1; i + 1 <= exact_.size(); ++i) {
            const double t = exact_[i].start, last = i + 1 < exact_.size() ? exact_[i + 1].start : length_;
            if (t - exact_[i - 1].start < 100 * resolution_ || last - t < 100 * resolution_) continue;
            dvec3 n = exact_[i].normal;
            double cosine = glm::dot(n, d_);
            if (cosine < 0) n = -n, cosine = -cosine;
            if (cosine < 0.02) continue;
            if (!is_smooth(scene_.object, o_ + t * d_, n, exact_[i - 1].phase, exact_[i].phase, resolution_)) continue;
            const Step* nearest = nullptr;
            for (const Step& s : steps_)
                if (!nearest || std::abs(s.t_to - t) < std::abs(nearest->t_to - t)) nearest = &s;
            // The field's own rounding, below half a resolution, moves the interface along a slanted ray.
            const double tolerance = (0.5 * resolution_ + (nearest ? nearest->aside : 0)) / cosine;
            if (!nearest || nearest->t_from > t + tolerance || nearest->t_to < t - tolerance) {
                if (totals_.misplaced++ < 3) complain("misplaced");
                continue;
            }
            check_normal(*nearest, n);
            // A tracer that knows only the label may take a label changed by rounding for a crossing.
            if (!nearest->is_rounded) check_leaving_rays(nearest->crossing);
        }
    }

    /// Checks the normal of a crossing, which is exactly n, and the ray reflected there.
    void check_normal(const Step& step, const dvec3& n) {
        const Hit& hit = step.crossing;
        const glm::vec3 normal = tracer_.normal(hit, probe_.d);
        ++totals_.normals;
        // The normal is evaluated at an end of the bracket, and the normal of a small ball changes on the way there.
        const auto is_off = [&](const dvec3& m) { return glm::length(glm::cross(dvec3(normal), m)) > 1e-3; };
        if (glm::dot(dvec3(normal), n) < 0 ||
            (is_off(n) && is_off(growth(scene_.object, dvec3(hit.p_from), hit.from, resolution_)) &&
             is_off(growth(scene_.object, dvec3(hit.p_to), hit.to, resolution_)))) {
            if (totals_.bad_normals++ < 3) complain("normal");
        }
        const glm::vec3 back = glm::normalize(probe_.d - 2 * glm::dot(probe_.d, normal) * normal);
        TraceCounters unused;
        const auto again = tracer_.first_crossing(hit.p_from, back, length_, hit.from, &hit, unused);
        ++totals_.reflections;
        if (again && again->t_to < tracer_.resolution()) {
            if (totals_.self_hits++ < 3) complain("a reflected ray hits where it starts");
        }
    }

    /// Checks that hints about a ray's start do not change its crossings, on whichever side it leaves.
    void check_leaving_rays(const Hit& hit) {
        const glm::vec3 normal = tracer_.normal(hit, probe_.d);
        Random rng(static_cast<std::uint64_t>(number_) + 1);
        for (const bool is_near : {true, false}) {
            glm::vec3 away = rng.direction();
            if ((glm::dot(away, normal) < 0) != is_near) away = -away;
            TraceCounters knowing, unknowing;
            const auto leave = [&](const Hit* start, TraceCounters& counters) {
                return tracer_.first_crossing(is_near ? hit.p_from : hit.p_to, away, length_,
                                              is_near ? hit.from : hit.to, start, counters);
            };
            const auto known = leave(&hit, knowing), unknown = leave(nullptr, unknowing);
            totals_.batches_knowing += knowing.batches;
            totals_.batches_unknowing += unknowing.batches;
            ++totals_.departures;
            if (known.has_value() != unknown.has_value() ||
                (known && std::abs(known->t_from - unknown->t_from) > 4 * tracer_.resolution()))
                if (totals_.strayed++ < 3) complain("a ray that leaves an interface strays");
        }
    }

    const Scene& scene_;
    const Tracer& tracer_;
    const Probe& probe_;
    const int number_;
    Totals& totals_;
    std::vector<std::string>& complaints_;

    const double resolution_ = tracer_.resolution();
    const dvec3 o_{probe_.o}, d_{probe_.d};
    const float length_ = 4 * tracer_.bounds().diagonal();
    const Phase first_ = tracer_.label(probe_.o);
    const std::vector<Piece> exact_ = exact_pieces(scene_.object, o_, d_, length_);
    std::vector<Step> steps_;
    bool creeps_ = false;
    double aside_ = 0;  ///< maximum distance of the last crossings from the exact ray
};

template <class Tracer>
void check_ray(const Scene& scene, const Tracer& tracer, const Probe& probe, int number, Totals& totals,
               std::vector<std::string>& complaints) {
    RayCheck<Tracer>(scene, tracer, probe, number, totals, complaints)();
}

/// `make(object, whole)` returns a tracer of the object; `whole` is the tracer of its whole program. `probe(rng, scene,
/// whole, tracer)` returns a ray.
template <class Make, class ProbeOf>
void trace_scenes(std::uint64_t seed, int scenes, int rays_each, Make&& make, ProbeOf&& probe, Totals& totals,
                  std::vector<std::string>& complaints) {
    Random rng(seed);
    for (int n = 0; n < scenes; ++n) {
        Scene scene;
        switch (n % 10) {
            case 0:
                scene = junction(rng, false);
                break;
            case 1:
                scene = junction(rng, true);
                break;
            case 2:
                scene = abutting(rng, false);
                break;
            case 3:
                scene = abutting(rng, true);
                break;
            case 4:
                scene = thin(rng);
                break;
            case 5:
                scene = vessel(rng);
                break;
            default:
                scene = random_scene(rng);
        }
        std::optional<InterfaceTracer> whole;
        try {
            whole.emplace(scene.object);
        } catch (const ModelError&) {
            continue;  // cut to nothing
        }
        const auto tracer = make(scene.object, *whole);
        for (int ray = 0; ray < rays_each; ++ray)
            check_ray(scene, tracer, probe(rng, scene, *whole, tracer), ray, totals, complaints);
    }
}

inline void check_totals(const Totals& totals, const std::vector<std::string>& complaints) {
    for (const std::string& c : complaints) MESSAGE(c);
    MESSAGE(totals.rays, " rays, ", totals.crossings, " crossings, ", totals.normals, " normals, ", totals.reflections,
            " reflections, ", totals.departures, " departures, ", totals.strayed, " of them astray, ", totals.creeping,
            " rays creep, by at most ", totals.max_batches, " batches; ", totals.flickering,
            " rays within rounding of a face cross it more than 100 times, at most ", totals.most_crossings, "; ",
            totals.rounded, " crossings certain only up to rounding");
    CHECK(totals.wrong == 0);
    CHECK(totals.flickering < totals.rays / 2000);
    CHECK(totals.creeping > totals.rays / 2000);
    CHECK(totals.uncertified == 0);
    // About 4 in a million are. The additional one is for runs of few crossings, in which one may still occur.
    CHECK(totals.rounded <= 1 + totals.crossings / 200'000);
    CHECK(totals.wide == 0);
    CHECK(totals.over_sliver < totals.crossings / 2000);
    CHECK(totals.misplaced == 0);
    CHECK(totals.bad_normals == 0);
    CHECK(totals.self_hits == 0);
    CHECK(totals.strayed == 0);
    CHECK(totals.crossings > totals.rays);
    CHECK(totals.normals > totals.rays / 2);
}

}  // namespace phasetree::tests::traced
