// Best-first branch and bound over boxes. A box is excluded if the label cannot change within half the box's diagonal
// of its centre. Rays from the query point towards the nearest remaining box find interfaces that are certified on both
// sides, which bound the distance from above.

#include "embree_core/closest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "phasetree/math/spectral.hpp"

namespace phasetree::embree {

double largest_stretch(const glm::dmat3& m) {
    const glm::dmat3 gram = glm::transpose(m) * m;
    std::vector<double> entries;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) entries.push_back(gram[i][k]);
    return std::sqrt(largest_eigenvalue(std::move(entries), 3));
}

namespace {

constexpr int max_batches = 1 << 14;  // of batch_size points each

// Distances in world space.
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
    // A lower bound on the distance to the box.
    double lower_bound(const Bounds& box) const {
        if (is_similarity_) {
            const glm::vec3 nearest = glm::clamp(from_, box.low, box.high);
            return scale_ * glm::length(glm::dvec3(nearest) - glm::dvec3(from_));
        }
        const double radius = stretch_ * static_cast<double>(box.diagonal()) / 2;
        return std::max(0.0, distance(box.centre()) - radius);
    }
    double stretch() const { return stretch_; }
    // The radius of the largest world-space ball within the image of a ball of the object's space.
    double inscribed_radius(double radius) const { return shrink_ * radius; }

  private:
    glm::vec3 from_;
    glm::dmat3 map_;
    double scale_ = 1, stretch_ = 1, shrink_ = 1;
    bool is_similarity_ = true;
};

struct Candidate {
    double lower_bound;
    Bounds box;
    bool operator<(const Candidate& other) const { return lower_bound > other.lower_bound; }  // the nearest on top
};

// The octants of one or more boxes, as many as fit into a batch of points.
struct Octants {
    std::array<Bounds, batch_size> part;
    std::size_t count = 0;

    bool has_room() const { return count + 8 <= batch_size; }
    void add_parts_of(const Bounds& box) {
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 c = box.centre(), far = box.corner(corner);
            part[count++] = {glm::min(c, far), glm::max(c, far)};
        }
    }
    void sample_centres(const Evaluator& evaluator, Samples& samples, Evaluator::Workspace& workspace) const {
        BatchOfFloats x{}, y{}, z{};
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::vec3 c = part[std::min(i, count - 1)].centre();
            x[i] = c.x;
            y[i] = c.y;
            z[i] = c.z;
        }
        evaluator.sample(x, y, z, samples, workspace);
    }
};
static_assert(batch_size >= 8, "one box's parts must fit");

// One search: the closest interface found so far, and the boxes that may have a closer one.
class Search {
  public:
    Search(const CellScene& object, const glm::vec3& point, const glm::dmat3& to_world, float radius, float tolerance)
        : object_(object),
          cells_(object.cells()),
          whole_(cells_.whole()),
          workspace_(Evaluator::thread_workspace()),
          point_(point),
          metric_(point, to_world),
          tolerance_(static_cast<double>(tolerance)),
          rounding_(cells_.resolution()),
          near_enough_(4 * static_cast<double>(cells_.resolution()) * metric_.stretch()),
          opaque_(cells_.opaque()),
          upper_(static_cast<double>(radius)) {}

    Closest run() {
        if (cells_.bounds().contains(point_)) guess_from_distances();
        remaining_.push({metric_.lower_bound(cells_.bounds()), cells_.bounds()});
        nearest_undivided_ = upper_;
        for (int batches = 0; !is_done() && batches < max_batches; ++batches) divide_nearest();
        const double rest =
            remaining_.empty() ? nearest_undivided_ : std::min(remaining_.top().lower_bound, nearest_undivided_);
        best_.empty_radius = static_cast<float>(std::max(empty_radius_, std::min(rest, upper_)));
        best_.distance = static_cast<float>(upper_);
        if (best_.found) best_.empty_radius = std::min(best_.empty_radius, best_.distance);
        return best_;
    }

  private:
    // The radius around a point within which there is no interface of interest: the smallest distance to the boundary
    // of a phase that is not opaque.
    float clear_distance(const glm::vec3& p) {
        const Phases<float> phi = whole_.distances(p, workspace_);
        float distance = std::numeric_limits<float>::max();
        for_each_phase(phi.present & ~opaque_.bits, [&](int i) { distance = std::min(distance, std::abs(phi[i])); });
        return distance;
    }

    // Traces from the query point to `towards` and on, for the length `beyond`. Keeps the first crossing if it is the
    // closest so far.
    void shoot(const glm::vec3& towards, float beyond) {
        const glm::dvec3 way = glm::dvec3(towards) - glm::dvec3(point_);
        const double length = glm::length(way);
        if (!(length > 0)) return;
        const UnitRay ray{point_, glm::vec3(way / length), 0, static_cast<float>(length) + beyond};
        const auto found = object_.first_crossing(ray, std::nullopt);
        if (!found || (opaque_.contains(found->crossing.from) && opaque_.contains(found->crossing.to))) return;
        const double distance = metric_.distance(found->crossing.p_from);
        if (distance > upper_ || (best_.found && distance == upper_)) return;
        upper_ = distance;
        best_.found = true;
        best_.point = found->crossing.p_from;
        best_.here = found->crossing.from;
        best_.there = found->crossing.to;
    }

    // The distances at the point give a lower bound on how far away the next phase is, and their gradient its
    // direction.
    void guess_from_distances() {
        const Phases<float> phi = whole_.distances(point_, workspace_);
        int first = -1, second = -1;
        for_each_phase(phi.present, [&](int i) {
            if (first < 0 || phi[i] < phi[first])
                second = first, first = i;
            else if (second < 0 || phi[i] < phi[second])
                second = i;
        });
        if (second < 0) return;
        const float free = opaque_.empty() ? phi[second] : clear_distance(point_);
        empty_radius_ = metric_.inscribed_radius(static_cast<double>(std::max(free - rounding_, 0.0f)));
        const glm::vec3 down = whole_.gradient(point_, Phase{static_cast<std::uint8_t>(second)});
        if (glm::length(down) > 0) shoot(point_ - glm::normalize(down) * std::max(2 * phi[second], 8 * rounding_), 0);
    }

    bool is_done() const {
        // Boxes that are no nearer than the interface found need not be divided.
        if (remaining_.empty() || !(remaining_.top().lower_bound < upper_)) return true;
        const double next = std::min(remaining_.top().lower_bound, nearest_undivided_);
        if (next >= upper_) return true;
        return best_.found && (next >= upper_ * (1 - tolerance_) || upper_ - next <= near_enough_);
    }

    // Divides the nearest boxes into octants, and keeps those that may have a closer interface.
    void divide_nearest() {
        Octants octants;
        while (octants.has_room() && !remaining_.empty() && remaining_.top().lower_bound < upper_) {
            const Bounds box = remaining_.top().box;
            remaining_.pop();
            shoot(box.centre(), box.diagonal());
            octants.add_parts_of(box);
        }
        Samples samples;
        octants.sample_centres(whole_, samples, workspace_);
        for (std::size_t i = 0; i < octants.count; ++i) {
            const Bounds& part = octants.part[i];
            const float reach = 0.5f * part.diagonal();
            const float free = opaque_.empty() ? samples.distance[i] : clear_distance(part.centre());
            if (free - rounding_ > reach) continue;
            const double lower_bound = metric_.lower_bound(part);
            if (lower_bound >= upper_) continue;
            if (reach < cells_.resolution())
                nearest_undivided_ = std::min(nearest_undivided_, lower_bound);
            else
                remaining_.push({lower_bound, part});
        }
    }

    const CellScene& object_;
    const InterfaceCells& cells_;
    const Evaluator& whole_;
    Evaluator::Workspace& workspace_;
    const glm::vec3 point_;
    const Metric metric_;
    const double tolerance_;
    const float rounding_;      // the rounding error of distances for which the search makes allowance
    const double near_enough_;  // in world space: the search ends once the bounds differ by at most this
    const PhaseSet opaque_;

    Closest best_;
    double upper_;  // the distance of best_, or the radius that is searched; in world space, like the members below
    double empty_radius_ = 0;  // nothing is nearer
    std::priority_queue<Candidate> remaining_;
    double nearest_undivided_ = 0;  // a bound for the boxes that are too small to divide
};

}  // namespace

Closest find_closest(const CellScene& object, const glm::vec3& point, const glm::dmat3& to_world, float radius,
                     float tolerance) {
    return Search(object, point, to_world, radius, tolerance).run();
}

}  // namespace phasetree::embree
