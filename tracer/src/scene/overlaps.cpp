#include "scene/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <tuple>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/spectral.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::tracer {

namespace {

// Few per pair of objects, so that overlaps of one pair do not hide those of another.
constexpr std::size_t most_found = 12, most_found_of_objects = 3;
constexpr std::size_t most_pairs = 200'000, most_evaluations_of_pair = 4096;
constexpr std::size_t max_evaluations = 4'000'000;
// Only this many copies are checked.
constexpr std::uint32_t most_looked_at = 2'000'000;
// As a fraction of the smaller box's diagonal.
constexpr double depth_that_counts = 1e-4;

struct CopyInBox {
    Bounds bounds;
    OverlappingCopy copy;
    Transform to_object;
};

// A lower bound on the depth of a scene point inside an object: its distance to the object's exterior.
class DepthField {
  public:
    explicit DepthField(const Phased& tree) : evaluator_(record(tree)) {}
    // For a point in object space, in its unit of length.
    double at(const glm::vec3& p) const {
        const Phases<float> phi = evaluator_.distances(p, Evaluator::thread_workspace());
        // The vacuum's component is positive inside. An object without a vacuum is everywhere.
        return static_cast<double>(phi.has(0) ? phi[0] : Bounds::infinity);
    }

  private:
    Evaluator evaluator_;
};

struct Part {
    double bound = 0;  // upper bound on the depth in both objects over the box
    std::size_t number = 0;
    Bounds box;
    bool operator<(const Part& other) const { return std::tie(bound, other.number) < std::tie(other.bound, number); }
};

class Search {
  public:
    explicit Search(const PlacedObjects& placed) {
        for (const PlacedObject& object : placed.objects) {
            boxes_.push_back(bounds(object.tree));
            depths_.emplace_back(object.tree);
        }
        std::size_t next = 0;
        placed.each_copy([&](std::uint32_t number, const PlacedObject& object, const Transform& to_scene) {
            if (number == most_looked_at) {
                result_.is_cut_short = true;
                return false;
            }
            next = static_cast<std::size_t>(&object - placed.objects.data());
            const Transform inward = to_scene.inverse();
            copies_.push_back({to_scene.image(boxes_[next]), {number, static_cast<std::uint32_t>(next)}, inward});
            return true;
        });
        std::erase_if(copies_, [](const CopyInBox& c) { return c.bounds.empty(); });
    }

    Overlaps run() && {
        if (!copies_.empty()) within(0, copies_.size());
        std::ranges::sort(result_.found, {},
                          [](const Overlap& o) { return std::pair(o.first.number, o.second.number); });
        return std::move(result_);
    }

  private:
    bool is_over() {
        if (result_.found.size() == most_found) {
            result_.has_more = true;
            return true;
        }
        if (pairs_ < most_pairs && evaluations_ < max_evaluations) return false;
        result_.is_cut_short = true;
        return true;
    }

    Bounds box_of(std::size_t from, std::size_t to) const {
        Bounds box;
        for (std::size_t i = from; i < to; ++i) box = unite(box, copies_[i].bounds);
        return box;
    }

    // Finds pairs in a range of copies: within each half, and between the halves.
    void within(std::size_t from, std::size_t to) {
        if (to - from < 2 || is_over()) return;
        const std::size_t middle = divide(from, to);
        within(from, middle);
        within(middle, to);
        between(from, middle, middle, to);
    }
    // Partitions along the longest side, by the centres of the boxes.
    std::size_t divide(std::size_t from, std::size_t to) {
        const glm::vec3 extent = box_of(from, to).extent();
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::size_t middle = from + (to - from) / 2;
        const auto at = [&](std::size_t i) { return copies_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(from), at(middle), at(to), [&](const CopyInBox& a, const CopyInBox& b) {
            const float x = a.bounds.centre()[axis], y = b.bounds.centre()[axis];
            return x != y ? x < y : a.copy.number < b.copy.number;
        });
        return middle;
    }
    void between(std::size_t a0, std::size_t a1, std::size_t b0, std::size_t b1) {
        if (is_over() || intersect(box_of(a0, a1), box_of(b0, b1)).empty()) return;
        if (a1 - a0 == 1 && b1 - b0 == 1) return look_at(copies_[a0], copies_[b0]);
        const bool divides_a = a1 - a0 >= b1 - b0;
        const std::size_t middle = divides_a ? a0 + (a1 - a0) / 2 : b0 + (b1 - b0) / 2;
        if (divides_a) {
            between(a0, middle, b0, b1);
            between(middle, a1, b0, b1);
        } else {
            between(a0, a1, b0, middle);
            between(a0, a1, middle, b1);
        }
    }

    // Searches for a sufficiently deep point in both by branch and bound. A component changes by no more than the
    // distance, so no point of a box is deeper than its centre plus half the diagonal.
    void look_at(const CopyInBox& a, const CopyInBox& b) {
        const auto objects = std::minmax(a.copy.object, b.copy.object);
        const auto is_of_these = [&](const Overlap& o) {
            return std::minmax(o.first.object, o.second.object) == objects;
        };
        if (std::ranges::count_if(result_.found, is_of_these) == std::ptrdiff_t(most_found_of_objects)) {
            result_.has_more = true;
            return;
        }
        ++pairs_;
        const double wanted =
            depth_that_counts * static_cast<double>(std::min(a.bounds.diagonal(), b.bounds.diagonal()));
        const double shrink_a = shrink(a.to_object), shrink_b = shrink(b.to_object);
        std::priority_queue<Part> parts;
        parts.push({Bounds::infinity, 0, intersect(a.bounds, b.bounds)});
        for (std::size_t number = 1; !parts.empty() && number < most_evaluations_of_pair;) {
            const Bounds box = parts.top().box;
            parts.pop();
            for (int corner = 0; corner < 8; ++corner) {
                const glm::vec3 far = box.corner(corner), centre = box.centre();
                const Bounds part{glm::min(far, centre), glm::max(far, centre)};
                const glm::vec3 p = part.centre();
                const double depth = std::min(shrink_a * depth_in(a, p), shrink_b * depth_in(b, p));
                ++evaluations_;
                if (depth > wanted) {
                    const bool is_in_order = a.copy.number < b.copy.number;
                    result_.found.push_back({is_in_order ? a.copy : b.copy, is_in_order ? b.copy : a.copy, p});
                    return;
                }
                const double bound = depth + 0.5 * static_cast<double>(part.diagonal());
                if (bound > wanted) parts.push({bound, number++, part});
            }
        }
    }
    double depth_in(const CopyInBox& copy, const glm::vec3& p) const {
        return depths_[copy.copy.object].at(glm::vec3(copy.to_object(p)));
    }
    // A lower bound on the ratio of lengths in the scene to lengths in the object.
    static double shrink(const Transform& to_object) {
        const glm::dmat3 gram = glm::transpose(to_object.matrix) * to_object.matrix;
        std::vector<double> entries;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) entries.push_back(gram[i][k]);
        return 1 / std::sqrt(largest_eigenvalue(std::move(entries), 3));
    }

    std::vector<Bounds> boxes_;  // one per object
    std::vector<DepthField> depths_;
    std::vector<CopyInBox> copies_;
    Overlaps result_;
    std::size_t pairs_ = 0, evaluations_ = 0;
};

}  // namespace

Overlaps find_overlaps(const PlacedObjects& placed) {
    return Search(placed).run();
}

}  // namespace phasetree::tracer
