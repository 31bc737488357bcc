// Whether a phase is nowhere thinner than required.
//
// *Proof.* All points of the phase are in boxes that may meet it. A box is done if the phase contains a ball of the
// required diameter whose centre is within reach of every point of the box. The ball is in the phase if this follows
// from the components at its centre, which are 1-Lipschitz, or from the boxes that it meets.
//
// *Disproof.* All centres within reach of some point of the phase are excluded: for each box that contains such
// centres, there is a box outside the phase that is closer than the radius to every point of it.
#include <algorithm>
#include <cmath>

#include "measuring/decide.hpp"

namespace phasetree::measuring {

namespace {

using Point = std::array<double, 3>;

double distance_between(const Point& a, const Point& b) {
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return std::sqrt(x * x + y * y + z * z);
}

Point moved(const Point& p, const Point& direction, double t) {
    return {p[0] + t * direction[0], p[1] + t * direction[1], p[2] + t * direction[2]};
}

glm::vec3 rounded_to_float(const Point& p) {
    return glm::vec3(glm::dvec3(p[0], p[1], p[2]));
}

Point widened(const glm::vec3& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

class Thickness {
  public:
    Thickness(const Evidence& e, const IsThick& s)
        : e_(e),
          octree_(e.octree),
          phase_(s.phase),
          radius_(0.5 * s.at_least),
          reach_(s.reach > 0 ? s.reach : s.at_least),
          whole_(e.octree.whole()),
          may_meet_(leaves_where(octree_, [&](const OctreeLeaf& l) { return l.is_possible(s.phase.index); })),
          outside_(leaves_where(octree_, [&](const OctreeLeaf& l) { return !l.is_possible(s.phase.index); })),
          doubtful_before_(octree_.leaves.size() + 1, 0) {
        for (std::size_t i = 0; i < octree_.leaves.size(); ++i)
            doubtful_before_[i + 1] = doubtful_before_[i] + (octree_.leaves[i].is_only(phase_.index) ? 0 : 1);
    }

    Proof run() {
        if (may_meet_.empty()) return {Verdict::refuted, "no point has this phase", {}, 0, {}};
        // Also keeps squares of lengths below from overflowing.
        if (const auto points = e_.points_of(PhaseSet::of(phase_)); points && radius_ > whole_.half_diagonal())
            return {Verdict::refuted, "no ball of this diameter fits into the object", *points, 0, {}};
        prove(may_meet_);
        if (e_.is_stopped()) return {};
        if (open_.empty() && e_.points_of(PhaseSet::of(phase_))) return {Verdict::proved, "", {}, 0, {}};
        for (const glm::vec3& p : most_suspicious(candidates())) {
            if (e_.is_stopped()) break;
            if (is_thin_at(widened(p)))
                return {Verdict::refuted, "no ball of this diameter is within reach", {{p, phase_}}, 0, {}};
        }
        return {};
    }

  private:
    // With this many open boxes, the phase is probably too thin somewhere. Others are then examined less thoroughly,
    // only to find out where it is thinnest.
    static constexpr std::size_t enough_open = 512, most_open = 1 << 16;
    static constexpr std::size_t most_candidates = 2048, most_suspects = 48;

    struct OpenBox {
        std::uint32_t leaf;
        double depth;  // of the deepest ball that was found near it
    };
    struct Candidate {
        glm::vec3 point;
        double depth;
    };

    // A lower bound of the distance from the outside, from the components.
    double depth(const glm::vec3& p) const {
        const Phases<float> values = e_.evaluator.distances(p, Evaluator::thread_workspace());
        if (!values.has(phase_.index)) return -1;
        double others = std::numeric_limits<double>::infinity();
        for_each_phase(values.present & ~PhaseSet::of(phase_).bits,
                       [&](int i) { others = std::min(others, static_cast<double>(values[i])); });
        const auto own = -static_cast<double>(values[phase_.index]);
        return std::max(own, std::isfinite(others) ? others : own) - static_cast<double>(octree_.value_error);
    }
    // Whether the ball is in the phase, judging by the boxes that it meets; these are in [begin, end).
    bool is_ball_in(const Point& centre, std::size_t begin, std::size_t end) const {
        if (doubtful_before_[end] == doubtful_before_[begin]) return true;
        const OctreeLeaf &first = octree_.leaves[begin], &last = octree_.leaves[end - 1];
        if (octree_.around(first.key, last.key, octree_.size_of(last)).distance(centre) >= radius_) return true;
        if (end - begin == 1) return false;
        const std::size_t middle = begin + (end - begin) / 2;
        return is_ball_in(centre, begin, middle) && is_ball_in(centre, middle, end);
    }
    bool is_centre(const glm::vec3& p) const {
        if (depth(p) >= radius_) return true;
        const Point c = widened(p);
        for (std::size_t i = 0; i < 3; ++i)
            if (c[i] - radius_ < whole_.low[i] || c[i] + radius_ > whole_.high[i]) return false;
        return is_ball_in(c, 0, octree_.leaves.size());
    }
    // The centre of a ball in the phase that is within reach of the whole box.
    bool find_centre(const Cube& box) {
        const double allowed = reach_ * (1 - 1e-9) - box.half_diagonal();
        last_depth_ = 0;
        if (!(allowed >= 0)) return false;
        const Point middle = box.centre();
        if (last_centre_ && distance_between(*last_centre_, middle) <= allowed) return true;
        glm::vec3 at = rounded_to_float(middle);
        glm::vec3 best = at;
        double best_depth = -std::numeric_limits<double>::infinity();
        constexpr int most_steps = 10;
        for (int step = 0; step < most_steps; ++step) {
            const double d = depth(at);
            if (d > best_depth) {
                best_depth = d;
                best = at;
            }
            if (d >= radius_) break;
            const glm::dvec3 inwards = -glm::dvec3(e_.evaluator.gradient(at, phase_));
            const double length = glm::length(inwards);
            if (!(length > 1e-6)) break;
            const double t = 1.02 * (radius_ - d) / length;
            Point next = moved(widened(at), {inwards.x, inwards.y, inwards.z}, t / length);
            const double far = distance_between(next, middle);
            if (far > allowed)
                next = moved(middle, {next[0] - middle[0], next[1] - middle[1], next[2] - middle[2]},
                             0.999 * allowed / far);
            if (rounded_to_float(next) == at) break;
            at = rounded_to_float(next);
        }
        last_depth_ = best_depth;
        if (distance_between(widened(best), middle) > allowed || !(best_depth > 0.2 * radius_) || !is_centre(best))
            return false;
        last_centre_ = widened(best);
        return true;
    }
    // Whether each point of the phase in a box is within reach of a ball. Divides the box if one ball is not enough, as
    // at edges, where the ball is nearly as far away as allowed.
    bool is_covered(const Cube& box, int depth) {
        constexpr int most_depth = 3;
        if (find_centre(box)) return true;
        const Point middle = box.centre();
        const Phases<float> values = e_.evaluator.distances(rounded_to_float(middle), Evaluator::thread_workspace());
        if (!values.has(phase_.index)) return true;
        const double margin = box.half_diagonal() * (1 + 1e-6) + 2 * static_cast<double>(octree_.value_error);
        if (static_cast<double>(values[phase_.index]) > margin) return true;
        if (depth == most_depth) return false;
        for (int k = 0; k < 8; ++k)
            if (!is_covered(part_of(box, k), depth + 1)) return false;
        return true;
    }
    static Cube part_of(const Cube& box, int k) {
        const Point middle = box.centre();
        Cube part = box;
        for (std::size_t i = 0; i < 3; ++i) ((k >> i) & 1 ? part.low : part.high)[i] = middle[i];
        return part;
    }
    void prove(std::span<const std::uint32_t> leaves) {
        if (open_.size() >= most_open || e_.is_stopped()) return;
        const bool is_covered_at_once = find_centre(cube_of(octree_, leaves));
        const double depth = last_depth_;
        if (is_covered_at_once) return;
        if (leaves.size() == 1) {
            if (open_.size() >= enough_open || !is_covered(cube_of(octree_, leaves), 0))
                open_.push_back({leaves.front(), depth});
            return;
        }
        const std::size_t middle = leaves.size() / 2;
        prove(leaves.first(middle));
        prove(leaves.subspan(middle));
    }

    // Points of the phase in some of the open boxes.
    std::vector<Candidate> candidates() const {
        std::vector<Candidate> points;
        const std::size_t step = std::max<std::size_t>(1, open_.size() / most_candidates);
        for (std::size_t i = 0; i < open_.size(); i += step)
            if (const auto p = point_in(octree_.leaves[open_[i].leaf])) points.push_back({*p, open_[i].depth});
        return points;
    }
    // Most candidates are at edges, where the phase is nearly thick enough. So most suspects are those with the
    // shallowest balls near them; the others are taken evenly.
    static std::vector<glm::vec3> most_suspicious(std::vector<Candidate> all) {
        std::vector<glm::vec3> chosen;
        constexpr std::size_t evenly = most_suspects / 3;
        const std::size_t step = std::max<std::size_t>(1, all.size() / evenly);
        std::vector<glm::vec3> others;
        for (std::size_t i = 0; i < all.size(); i += step) others.push_back(all[i].point);
        std::ranges::stable_sort(all, {}, &Candidate::depth);
        for (std::size_t i = 0; i < std::min(all.size(), most_suspects - evenly); ++i) chosen.push_back(all[i].point);
        chosen.insert(chosen.end(), others.begin(), others.end());
        return chosen;
    }
    // The deepest of some points of a leaf, if one is certainly in the phase.
    std::optional<glm::vec3> point_in(const OctreeLeaf& leaf) const {
        const Cube cube = octree_.cube(leaf);
        if (leaf.is_only(phase_.index)) return rounded_to_float(cube.centre());
        std::optional<glm::vec3> deepest;
        double least = 2 * static_cast<double>(octree_.value_error);
        for (int k = 0; k < 9; ++k) {
            Point p = cube.centre();
            for (std::size_t axis = 0; axis < 3 && k < 8; ++axis)
                p[axis] += ((k >> axis) & 1 ? 0.29 : -0.29) * (cube.high[axis] - cube.low[axis]);
            const glm::vec3 at = rounded_to_float(p);
            const Phases<float> values = e_.evaluator.distances(at, Evaluator::thread_workspace());
            const double d = values.has(phase_.index) ? -static_cast<double>(values[phase_.index]) : 0;
            if (d > least) {
                least = d;
                deepest = at;
            }
        }
        return deepest;
    }
    // An upper bound of the distance from the outside, or of `limit` if that is less.
    double distance_of_outside(const Point& p, double limit) const {
        for (std::size_t i = 0; i < 3; ++i)
            limit = std::min(limit, std::max(0.0, std::min(p[i] - whole_.low[i], whole_.high[i] - p[i])));
        if (!outside_.empty()) search_outside(p, outside_, limit);
        return limit;
    }
    void search_outside(const Point& p, std::span<const std::uint32_t> leaves, double& limit) const {
        const double d = cube_of(octree_, leaves).distance(p);
        if (!(d < limit)) return;
        if (leaves.size() == 1) {
            limit = d;
            return;
        }
        const auto left = leaves.first(leaves.size() / 2), right = leaves.subspan(leaves.size() / 2);
        const bool is_left_first = cube_of(octree_, left).distance(p) <= cube_of(octree_, right).distance(p);
        search_outside(p, is_left_first ? left : right, limit);
        search_outside(p, is_left_first ? right : left, limit);
    }
    // Whether no ball in the phase has its centre within reach.
    bool is_thin_at(const Point& p) const {
        constexpr std::size_t most_boxes = 8000;
        std::vector<Cube> boxes(1);
        for (std::size_t i = 0; i < 3; ++i) {
            boxes[0].low[i] = p[i] - reach_;
            boxes[0].high[i] = p[i] + reach_;
        }
        StopPoll poll(e_.is_stopped);
        for (std::size_t count = 0; !boxes.empty(); ++count) {
            poll();
            const Cube box = boxes.back();
            boxes.pop_back();
            if (box.distance(p) > reach_ * (1 + 1e-9)) continue;
            const Point middle = box.centre();
            const double half = box.half_diagonal();
            const double outside = distance_of_outside(middle, 2 * radius_);
            if (outside + half < radius_ * (1 - 1e-9)) continue;
            const bool may_be_centre = outside >= radius_ * (1 - 1e-9) && distance_between(middle, p) <= reach_;
            if (may_be_centre || half < 0.25 * octree_.side() || count > most_boxes) return false;
            for (int k = 0; k < 8; ++k) boxes.push_back(part_of(box, k));
        }
        return true;
    }

    const Evidence& e_;
    const PhaseOctree& octree_;
    Phase phase_;
    double radius_, reach_;
    Cube whole_;
    std::vector<std::uint32_t> may_meet_, outside_;
    // For each leaf, how many of the leaves before it are not certainly in the phase.
    std::vector<std::uint32_t> doubtful_before_;
    std::vector<OpenBox> open_;  // those for which no ball was found
    std::optional<Point> last_centre_;
    double last_depth_ = 0;  // of the deepest ball that find_centre() last found, within reach of the box or not
};

}  // namespace

Proof decide(const Evidence& e, const IsThick& s) {
    return Thickness(e, s).run();
}

}  // namespace phasetree::measuring
