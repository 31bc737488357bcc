#include "trace/faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "evaluation/target.hpp"

namespace phasetree::trace {

using evaluation::active_kernel;
using kernel::FaceBatch, kernel::FaceHit, kernel::most_faces;

namespace {

constexpr double infinite_distance = std::numeric_limits<double>::infinity();

// The crossings of a line with a cell's faces, in any order.
class FaceHits {
  public:
    FaceHits(const FacesOfCell& cell, const TracedRay& ray)
        : count_(kernel::meet_faces_for(active_kernel())(cell.faces.data(), cell.faces.size(), ray, hits_.data())) {}
    const FaceHit* begin() const { return hits_.data(); }
    const FaceHit* end() const { return hits_.data() + count_; }
    bool empty() const { return count_ == 0; }

  private:
    std::array<FaceHit, most_faces> hits_;  // intentionally uninitialised
    std::size_t count_;
};

glm::vec3 point_at(const TracedRay& ray, double t) {
    return glm::vec3(glm::dvec3(ray.origin) + t * glm::dvec3(ray.direction));
}

// The part of a ray's line in a box; empty if low > high.
struct Part {
    double low = -infinite_distance, high = infinite_distance;
};
Part part_in(const Bounds& box, const TracedRay& ray) {
    Part part;
    for (int axis = 0; axis < 3; ++axis) {
        const auto origin = static_cast<double>(ray.origin[axis]);
        const double to_low = static_cast<double>(box.low[axis]) - origin;
        const double to_high = static_cast<double>(box.high[axis]) - origin;
        if (ray.direction[axis] == 0) {
            if (to_low > 0 || to_high < 0) part.high = -infinite_distance;
            continue;
        }
        const double a = to_low * ray.inverse[axis], b = to_high * ray.inverse[axis];
        part.low = std::max(part.low, std::min(a, b));
        part.high = std::min(part.high, std::max(a, b));
    }
    return part;
}

// A face in doubles: a corner, and the normal into the phase `first`, which is not of unit length.
struct Plane {
    glm::dvec3 corner, normal;

    Plane(std::span<const FaceBatch> faces, std::uint32_t face) {
        const FaceBatch& batch = faces[face / batch_size];
        const auto at = [&](std::size_t i) {
            const std::size_t lane = face % batch_size;
            return glm::dvec3(batch.at[3 * i][lane], batch.at[3 * i + 1][lane], batch.at[3 * i + 2][lane]);
        };
        corner = at(0);
        normal = glm::cross(at(1) - corner, at(2) - corner);
    }
    double side(const glm::vec3& p) const { return glm::dot(normal, glm::dvec3(p) - corner); }
};

// The crossings that matter for a ray in a phase. Distances are infinite if there is none.
struct Nearest {
    FaceHit leaving{infinite_distance, 0, false};
    double entering = infinite_distance;
    bool has_passed = false;                        // an entering one was passed at the start
    double last_before_start = -infinite_distance;  // the last crossing before the start of the ray,
    bool is_last_before_entering = false;           // and whether it enters the carried phase

    // `is_front`: whether the ray leaves its phase through front faces. The ray starts at `begin`. Entering crossings
    // up to `passed` are skipped. Crossings before the start are considered back to `low`.
    Nearest(const FaceHits& hits, bool is_front, double low, double begin, double passed) {
        for (const FaceHit& hit : hits) {
            const bool is_leaving = hit.is_front == is_front;
            if (hit.t < begin) {
                if (hit.t >= low && hit.t > last_before_start) {
                    last_before_start = hit.t;
                    is_last_before_entering = !is_leaving;
                }
            } else if (is_leaving) {
                if (hit.t < leaving.t) leaving = hit;
            } else if (hit.t <= passed) {
                has_passed = true;
            } else {
                entering = std::min(entering, hit.t);
            }
        }
    }
};

// Moves a point to the side of a plane with this sign if rounding has put it on the plane or beyond. Three units in the
// last place are enough: rounding moves a point by at most half a unit along each axis. Returns whether it is there.
bool move_to_side(glm::vec3& p, const Plane& plane, double sign) {
    const glm::dvec3 size = glm::abs(plane.normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const float towards = sign * plane.normal[axis] > 0 ? Bounds::infinity : -Bounds::infinity;
    for (int i = 0; i < 3 && !(sign * plane.side(p) > 0); ++i) p[axis] = std::nextafter(p[axis], towards);
    return sign * plane.side(p) > 0;
}

// The bracket around a crossing. Returns false if its ends are not on the two sides of the face.
bool bracket(const FacesOfCell& cell, const FaceVisit& visit, const FaceHit& hit, double begin, Crossing& c) {
    const double half = 0.49 * static_cast<double>(visit.resolution);
    const double in = std::max(hit.t - half, begin), out = hit.t + half;
    const Plane plane(cell.faces, hit.face);
    const double sign = hit.is_front ? 1 : -1;
    c = {static_cast<float>(in),
         static_cast<float>(out),
         point_at(visit.ray, in),
         point_at(visit.ray, out),
         hit.is_front ? cell.first : cell.other,
         hit.is_front ? cell.other : cell.first};
    return move_to_side(c.p_from, plane, sign) && move_to_side(c.p_to, plane, -sign);
}

// The crossing of a ray that is in the other phase where it enters the box.
Crossing change_at_entry(const FacesOfCell& cell, const FaceVisit& visit, double begin) {
    const auto t = static_cast<float>(begin);
    const glm::vec3 p = point_at(visit.ray, begin);
    return {t, t, p, p, *visit.carried, *visit.carried == cell.first ? cell.other : cell.first};
}

}  // namespace

FaceAnswer first_crossing(const FacesOfCell& cell, const FaceVisit& visit, Crossing& crossing) {
    const TracedRay& ray = visit.ray;
    const std::optional<Phase>& carried = visit.carried;
    if (!ray.is_traceable) return FaceAnswer::none;
    if (carried && *carried != cell.first && *carried != cell.other) return FaceAnswer::unclear;
    const FaceHits hits(cell, ray);
    const auto t_min = static_cast<double>(visit.t_min), resolution = static_cast<double>(visit.resolution);
    if (hits.empty()) {
        const bool may_be_in_other_phase = carried && cell.box.contains(point_at(ray, t_min));
        return may_be_in_other_phase ? FaceAnswer::none_if_in_phase : FaceAnswer::none;
    }
    const Part box = part_in(cell.box, ray);
    const double begin = std::max(box.low, t_min), end = std::min(box.high, static_cast<double>(visit.t_max));
    if (!(begin <= end)) return FaceAnswer::none;
    const bool starts_here = carried && t_min >= box.low;

    bool is_front = carried == cell.first;
    if (!carried) {
        // The ray is in the phase on the near side of the first face.
        FaceHit first{infinite_distance, 0, false};
        for (const FaceHit& hit : hits)
            if (hit.t >= begin && hit.t < first.t) first = hit;
        is_front = first.is_front;
    }
    const double low = std::min(box.low, begin - 4 * resolution);
    const Nearest nearest(hits, is_front, low, begin, starts_here ? begin + 4 * resolution : begin);
    const double leaving = nearest.leaving.t;
    if (nearest.entering <= std::min(leaving, end)) {
        const double reach = 4 * resolution;
        if (starts_here || nearest.last_before_start >= begin - reach || nearest.entering <= begin + reach)
            return FaceAnswer::unclear;
        crossing = change_at_entry(cell, visit, begin);
        return FaceAnswer::crossing;
    }
    if (!(leaving <= end)) {
        const bool is_certain = !starts_here || nearest.has_passed || nearest.is_last_before_entering;
        return is_certain ? FaceAnswer::none : FaceAnswer::none_if_in_phase;
    }
    if (nearest.entering - leaving < 3 * resolution) return FaceAnswer::unclear;
    return bracket(cell, visit, nearest.leaving, begin, crossing) ? FaceAnswer::crossing : FaceAnswer::unclear;
}

std::optional<glm::vec3> normal_of_face(const FacesOfCell& cell, const Crossing& crossing, const glm::vec3& direction,
                                        float resolution) {
    if (crossing.from != cell.first && crossing.from != cell.other) return std::nullopt;
    const FaceHits hits(cell, TracedRay(crossing.p_from, direction));
    const double width = static_cast<double>(glm::dot(crossing.p_to - crossing.p_from, direction));
    double nearest = width / 2 + static_cast<double>(resolution);
    const FaceHit* found = nullptr;
    for (const FaceHit& hit : hits) {
        const double away = std::abs(hit.t - width / 2);
        if (hit.is_front != (crossing.from == cell.first) || !(away < nearest)) continue;
        nearest = away;
        found = &hit;
    }
    if (!found) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(Plane(cell.faces, found->face).normal);
    return glm::vec3(found->is_front ? -normal : normal);
}

}  // namespace phasetree::trace
