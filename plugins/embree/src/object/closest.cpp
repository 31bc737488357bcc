/// Best-first branch and bound over boxes: s(p), the distance within which the label cannot change, excludes a box from
/// its centre; a ray from the point towards the nearest box that is left meets an interface that is certified on both
/// sides, and so bounds the distance from above.

#include "object/closest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace phasetree::embree {

namespace {

constexpr int most_batches = 1 << 14;

/// Distances as the world measures them.
class Metric {
  public:
    Metric(const glm::vec3& from, const glm::dmat3& to_world) : from_(from), map_(to_world) {
        const glm::dmat3 gram = glm::transpose(map_) * map_;
        scale_ = std::sqrt((gram[0][0] + gram[1][1] + gram[2][2]) / 3);
        const double square = scale_ * scale_;
        is_similarity_ = true;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                if (std::abs(gram[i][k] - (i == k ? square : 0)) > 1e-6 * square) is_similarity_ = false;
        stretch_ = is_similarity_ ? scale_ : largest_stretch(map_);
        shrink_ = is_similarity_ ? scale_ : 1 / largest_stretch(glm::inverse(map_));
    }

    double distance(const glm::vec3& p) const { return glm::length(map_ * (glm::dvec3(p) - glm::dvec3(from_))); }
    /// No point of the box is nearer.
    double below(const Bounds& box) const {
        if (is_similarity_) {
            const glm::vec3 nearest = glm::clamp(from_, box.low, box.high);
            return scale_ * glm::length(glm::dvec3(nearest) - glm::dvec3(from_));
        }
        const double radius = stretch_ * static_cast<double>(box.diagonal()) / 2;
        return std::max(0.0, distance(box.centre()) - radius);
    }
    double stretch() const { return stretch_; }
    /// The radius in the world of a ball of the object's space, from within.
    double ball(double radius) const { return shrink_ * radius; }

  private:
    glm::vec3 from_;
    glm::dmat3 map_;
    double scale_ = 1, stretch_ = 1, shrink_ = 1;
    bool is_similarity_ = true;
};

struct Candidate {
    double below;
    Bounds box;
    bool operator<(const Candidate& other) const { return below > other.below; }  // the nearest on top
};

}  // namespace

Closest find_closest(const CellScene& object, const glm::vec3& point, const glm::dmat3& to_world, float radius,
                     float tolerance) {
    const InterfaceCells& cells = object.cells();
    const Evaluator& whole = cells.whole();
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    const Metric metric(point, to_world);
    // What rounding can make of a distance, as the cells reckon.
    const float rounding = cells.resolution();
    const double near_enough = 4 * static_cast<double>(cells.resolution()) * metric.stretch();

    // A ball about a point in which no interface passes that a ray can meet: one of a phase that is not opaque.
    const PhaseSet opaque = cells.opaque();
    const auto clear_distance = [&](const glm::vec3& p) {
        const Phases<float> phi = whole.distances(p, workspace);
        float distance = std::numeric_limits<float>::max();
        for_each_phase(phi.present & ~opaque.bits, [&](int i) { distance = std::min(distance, std::abs(phi[i])); });
        return distance;
    };

    Closest best;
    double nearest = static_cast<double>(radius);
    const auto shoot = [&](const glm::vec3& towards, float beyond) {
        const glm::dvec3 way = glm::dvec3(towards) - glm::dvec3(point);
        const double length = glm::length(way);
        if (!(length > 0)) return;
        const UnitRay ray{point, glm::vec3(way / length), 0, static_cast<float>(length) + beyond};
        const auto found = object.first_crossing(ray, std::nullopt);
        if (!found || (opaque.contains(found->crossing.from) && opaque.contains(found->crossing.to))) return;
        const double distance = metric.distance(found->crossing.p_in);
        if (distance > nearest || (best.found && distance == nearest)) return;
        nearest = distance;
        best.found = true;
        best.point = found->crossing.p_in;
        best.here = found->crossing.from;
        best.there = found->crossing.to;
    };

    double lower = 0;  // nothing is nearer
    if (cells.bounds().contains(point)) {
        const Phases<float> phi = whole.distances(point, workspace);
        int first = -1, second = -1;
        for_each_phase(phi.present, [&](int i) {
            if (first < 0 || phi[i] < phi[first])
                second = first, first = i;
            else if (second < 0 || phi[i] < phi[second])
                second = i;
        });
        if (second >= 0) {
            const float free = opaque.empty() ? phi[second] : clear_distance(point);
            lower = metric.ball(static_cast<double>(std::max(free - rounding, 0.0f)));
            const glm::vec3 down = whole.gradient(point, Phase{static_cast<std::uint8_t>(second)});
            if (glm::length(down) > 0) shoot(point - glm::normalize(down) * std::max(2 * phi[second], 8 * rounding), 0);
        }
    }

    std::priority_queue<Candidate> left;
    left.push({metric.below(cells.bounds()), cells.bounds()});
    double floor = nearest;  // of what is too small to divide
    const auto is_done = [&] {
        if (left.empty()) return true;
        const double next = std::min(left.top().below, floor);
        if (next >= nearest) return true;
        return best.found && (next >= nearest * (1 - static_cast<double>(tolerance)) || nearest - next <= near_enough);
    };
    for (int batches = 0; !is_done() && batches < most_batches; ++batches) {
        static_assert(batch_size >= 8, "one box's parts must fit");
        std::array<Bounds, batch_size> part;
        std::size_t count = 0;
        while (count + 8 <= batch_size && !left.empty() && left.top().below < nearest) {
            const Bounds box = left.top().box;
            left.pop();
            shoot(box.centre(), box.diagonal());
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 c = box.centre(), far = box.corner(corner);
                part[count++] = {glm::min(c, far), glm::max(c, far)};
            }
        }
        BatchOfFloats x{}, y{}, z{};
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::vec3 c = part[std::min(i, count - 1)].centre();
            x[i] = c.x;
            y[i] = c.y;
            z[i] = c.z;
        }
        Samples samples;
        whole.sample(x, y, z, samples, workspace);
        for (std::size_t i = 0; i < count; ++i) {
            const float reach = 0.5f * part[i].diagonal();
            const float free = opaque.empty() ? samples.distance[i] : clear_distance(part[i].centre());
            if (free - rounding > reach) continue;
            const double below = metric.below(part[i]);
            if (below >= nearest) continue;
            if (reach < cells.resolution())
                floor = std::min(floor, below);
            else
                left.push({below, part[i]});
        }
    }
    const double rest = left.empty() ? floor : std::min(left.top().below, floor);
    best.empty_radius = static_cast<float>(std::max(lower, std::min(rest, nearest)));
    best.distance = static_cast<float>(nearest);
    if (best.found) best.empty_radius = std::min(best.empty_radius, best.distance);
    return best;
}

}  // namespace phasetree::embree
