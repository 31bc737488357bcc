// Chooses planes that bound a solid tightly. support.cpp guarantees that the planes are valid; this file only chooses
// directions, so a choice may be poor but never wrong.
//
// First come the six sides of a box. Then come the solid's own flat sides: rays are sphere-traced onto it from all
// around, and normals found by several rays become directions. Finally, corners are cut off: the corner of the current
// polyhedron that is farthest from the solid is cut by a plane perpendicular to the direction from the solid to it.
#include "phasetree/carving/carve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "carving/support.hpp"
#include "math/clip_line.hpp"
#include "phasetree/nodes/fields/merge.hpp"
#include "phasetree/nodes/fields/polyhedron.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/trace/tracer.hpp"
#include "phasetree/tree/unbounded.hpp"

namespace phasetree {

using carving::BallBatch, carving::EmptyBalls, carving::Support, carving::support_along;

namespace {

// Directions closer to each other than this (5°) count as the same.
constexpr double same_direction = 0.9962;
constexpr std::size_t rays = 96, max_steps = 96;

class Carver {
  public:
    Carver(const Field& field, const Bounds& box, const CarveOptions& options)
        : options_(options),
          field_(field, box, options),
          tolerance_(options.tolerance * static_cast<double>(box.diagonal())),
          box_(box) {}

    CarvedBounds run() {
        carve_box();
        if (options_.directions.empty()) {
            add_flat_sides();
            cut_corners();
        } else {
            for (const glm::dvec3& d : options_.directions) add(glm::normalize(d));
        }
        CarvedBounds result;
        if (is_empty_) {
            result.evaluations = field_.evaluations();
            return result;
        }
        const ConvexPolyhedron solid(box_, planes_);
        result.box = box_;
        result.mesh = solid.mesh();
        result.volume = solid.volume();
        result.area = solid.area();
        result.planes = planes_that_matter(solid);
        result.evaluations = field_.evaluations();
        result.is_within_tolerance = is_within_tolerance_;
        return result;
    }

  private:
    // 0 if the solid is empty.
    std::size_t evaluations_left() const {
        if (is_empty_) return 0;
        return options_.max_evaluations - std::min(options_.max_evaluations, field_.evaluations());
    }
    // The height of a plane perpendicular to d. No direction gets more than twice an even share of the remaining
    // evaluations.
    double support(const glm::dvec3& d) {
        const auto planes = static_cast<std::size_t>(
            options_.directions.empty() ? options_.max_planes : static_cast<int>(options_.directions.size()) + 6);
        const Support r = support_along(d, field_, box_, tolerance_,
                                        std::min(evaluations_left(), 2 * options_.max_evaluations / planes));
        is_within_tolerance_ = is_within_tolerance_ && r.is_within_tolerance;
        is_empty_ = is_empty_ || r.upper == -std::numeric_limits<double>::infinity();
        return r.upper;
    }

    // Rounds the sides outwards to floats.
    void carve_box() {
        for (int side = 0; side < 6 && !is_empty_; ++side) {
            glm::dvec3 d(0);
            const int axis = side / 2;
            const bool is_high = side % 2 == 1;
            d[axis] = is_high ? 1 : -1;
            const double height = support(d);
            if (is_empty_) return;
            float& to = is_high ? box_.high[axis] : box_.low[axis];
            const auto rounded = static_cast<float>(is_high ? height : -height);
            const float outward = std::nextafter(rounded, is_high ? Bounds::infinity : -Bounds::infinity);
            to = is_high ? std::min(to, outward) : std::max(to, outward);
        }
    }

    bool is_known(const glm::dvec3& d) const {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(d[axis]) > same_direction) return true;
        return std::any_of(planes_.begin(), planes_.end(),
                           [&](const HalfSpace& h) { return glm::dot(h.normal, d) > same_direction; });
    }
    int count() const { return 6 + static_cast<int>(planes_.size()); }

    void add(const glm::dvec3& d) { planes_.push_back({d, support(d)}); }

    // The normals where rays from all around meet the solid.
    std::vector<glm::dvec3> normals_around() {
        const glm::dvec3 middle(box_.centre());
        const double radius = 0.5 * static_cast<double>(box_.diagonal());
        std::vector<glm::dvec3> normals;
        for (std::size_t first = 0; first < rays; first += batch_size) {
            std::array<glm::dvec3, batch_size> outward, p;
            std::array<double, batch_size> t{};
            for (std::size_t i = 0; i < batch_size; ++i) {
                // Points of a Fibonacci spiral.
                const double k = static_cast<double>(first + i) + 0.5;
                const double z = 1 - 2 * k / static_cast<double>(rays), a = 2.399963229728653 * k;
                outward[i] = glm::dvec3(std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z);
            }
            std::array<bool, batch_size> has_hit{};
            for (std::size_t step = 0; step < max_steps && evaluations_left() > 0; ++step) {
                for (std::size_t i = 0; i < batch_size; ++i) p[i] = middle + outward[i] * (radius - t[i]);
                const BallBatch balls = field_.at(p);
                bool goes_on = false;
                for (std::size_t i = 0; i < batch_size; ++i) {
                    has_hit[i] = has_hit[i] || balls[i].radius < 0.1 * tolerance_;
                    if (has_hit[i] || t[i] > 2 * radius) continue;
                    t[i] += balls[i].radius;
                    goes_on = true;
                }
                if (!goes_on) break;
            }
            for (std::size_t i = 0; i < batch_size; ++i)
                if (has_hit[i]) normals.push_back(field_.gradient(p[i]));
        }
        return normals;
    }

    void add_flat_sides() {
        struct Side {
            glm::dvec3 normal;
            int votes;
        };
        std::vector<Side> sides;
        for (const glm::dvec3& g : normals_around()) {
            if (!(glm::length(g) > 1e-3)) continue;
            const glm::dvec3 n = glm::normalize(g);
            const auto same = std::find_if(sides.begin(), sides.end(),
                                           [&](const Side& s) { return glm::dot(s.normal, n) > 1 - 1e-4; });
            if (same == sides.end())
                sides.push_back({n, 1});
            else
                ++same->votes;
        }
        std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.votes > b.votes; });
        for (const Side& side : sides) {
            if (side.votes < 3 || count() >= options_.max_planes / 2 || evaluations_left() == 0) return;
            if (!is_known(side.normal)) add(side.normal);
        }
    }

    void cut_corners() {
        std::vector<glm::dvec3> done;  // corners that no plane cuts off
        while (count() < options_.max_planes && evaluations_left() > 0) {
            const auto corners = ConvexPolyhedron(box_, planes_).mesh().corners;
            std::vector<std::pair<double, glm::dvec3>> far;
            for (std::size_t first = 0; first < corners.size(); first += batch_size) {
                const std::size_t count = std::min(batch_size, corners.size() - first);
                const BallBatch balls = field_.at(std::span(corners).subspan(first, count));
                for (std::size_t i = 0; i < count; ++i)
                    if (balls[i].radius > 2 * tolerance_) far.emplace_back(balls[i].radius, corners[first + i]);
            }
            std::stable_sort(far.begin(), far.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
            const auto is_done = [&](const glm::dvec3& c) {
                return std::any_of(done.begin(), done.end(),
                                   [&](const glm::dvec3& o) { return glm::distance(o, c) < 0.1 * tolerance_; });
            };
            const auto next =
                std::find_if(far.begin(), far.end(), [&](const auto& corner) { return !is_done(corner.second); });
            if (next == far.end()) return;
            if (!cut(next->second)) done.push_back(next->second);
        }
    }
    // Cuts a corner off with a plane perpendicular to the direction from the solid, or otherwise to the direction from
    // the middle. Returns whether one of them succeeds.
    bool cut(const glm::dvec3& corner) {
        for (const glm::dvec3& way : {field_.gradient(corner), corner - glm::dvec3(box_.centre())}) {
            if (!(glm::length(way) > 1e-3 * tolerance_) || evaluations_left() == 0) continue;
            const glm::dvec3 d = glm::normalize(way);
            const double height = support(d);
            if (!(height < glm::dot(d, corner) - tolerance_)) continue;
            planes_.push_back({d, height});
            return true;
        }
        return false;
    }

    HalfSpace side_of_box(std::size_t side) const {
        const int axis = static_cast<int>(side % 3);
        const double sign = side < 3 ? -1 : 1;
        HalfSpace half{glm::dvec3(0), sign * static_cast<double>(side < 3 ? box_.low[axis] : box_.high[axis])};
        half.normal[axis] = sign;
        return half;
    }
    // The planes that have a face; all planes if the solid is so thin that there are no faces.
    std::vector<HalfSpace> planes_that_matter(const ConvexPolyhedron& solid) const {
        std::vector<HalfSpace> all;
        for (const ConvexPolyhedron::Face& face : solid.faces())
            all.push_back(face.plane < 6 ? side_of_box(face.plane) : planes_[face.plane - 6]);
        if (!all.empty()) return all;
        for (std::size_t side = 0; side < 6; ++side) all.push_back(side_of_box(side));
        all.insert(all.end(), planes_.begin(), planes_.end());
        return all;
    }

    const CarveOptions& options_;
    EmptyBalls field_;
    double tolerance_;
    Bounds box_;
    std::vector<HalfSpace> planes_;
    bool is_within_tolerance_ = true;
    bool is_empty_ = false;  // proven to be empty
};

void check(const CarveOptions& options) {
    for (const glm::dvec3& d : options.directions)
        if (!(glm::length(d) > 0) || !std::isfinite(glm::length(d)))
            throw ModelError("the length of a carving direction must be finite and not zero");
    if (options.directions.size() > Polyhedron::max_planes - 6)
        throw ModelError(fmt::format("there are {} carving directions; at most {} are allowed",
                                     options.directions.size(), Polyhedron::max_planes - 6));
    if (options.directions.empty() &&
        (options.max_planes < 6 || options.max_planes > static_cast<int>(Polyhedron::max_planes)))
        throw ModelError(fmt::format("the number of carving planes must be from 6 to {}, but is {}",
                                     Polyhedron::max_planes, options.max_planes));
    if (!(options.tolerance > 0))
        throw ModelError(fmt::format("the carving tolerance must be a positive number, but is {}", options.tolerance));
}

}  // namespace

CarvedBounds carve(const Field& field, const CarveOptions& options) {
    check(options);
    const Bounds box = bounds(field);
    if (box.empty()) return {};
    if (!box.finite()) throw UnboundedError(unbounded_parts(field));
    const TraceableObject traceable = prepare_to_trace(Set{.phase = Phase{1}, .of = field});
    return Carver(field, traceable.bounds, options).run();
}

CarvedBounds carve(const Phased& object, PhaseSet of, const CarveOptions& options) {
    if (of.contains(vacuum))
        throw ModelError("the vacuum is unbounded, so it has no carved bounds; select other phases");
    return carve(Field(Merge{.of = object, .phases = of}), options);
}

bool CarvedBounds::contains(const glm::dvec3& p) const {
    if (box.empty()) return false;
    return std::all_of(planes.begin(), planes.end(), [&](const HalfSpace& h) { return h.distance(p) <= 0; });
}

void CarvedBounds::clip(const glm::dvec3& origin, const glm::dvec3& direction, double& near, double& far) const {
    if (box.empty()) {
        far = near - 1;
        return;
    }
    clip_line(planes, origin, direction, near, far);
}

Field as_field(const CarvedBounds& carved) {
    if (carved.box.empty()) throw ModelError("the carved bounds are empty, so there is no field of them");
    Polyhedron node;
    for (const HalfSpace& h : carved.planes) {
        // Round outwards: rounding a normal moves the plane by no more than this within the box.
        double farthest = 0;
        for (int i = 0; i < 8; ++i) farthest = std::max(farthest, glm::length(glm::dvec3(carved.box.corner(i))));
        node.normals.emplace_back(h.normal);
        node.offsets.push_back(static_cast<float>(h.offset + 4e-7 * (farthest + std::abs(h.offset))));
    }
    return node;
}

}  // namespace phasetree
