#include "nodes/mesh_repair/arrange.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "model/preparation.hpp"
#include "nodes/box_tree.hpp"
#include "nodes/mesh_repair/contacts.hpp"
#include "nodes/mesh_repair/subdivision.hpp"
#include "nodes/mesh_repair/vertex_at.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::mesh {

namespace {

std::array<double, 3> key_of(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

// The elements with a key, of elements sorted by it. (Clang 14 cannot compile the range that std::ranges::equal_range
// returns.)
template <class Element, class Key, class KeyOf>
std::span<const Element> with_key(const std::vector<Element>& sorted, const Key& key, KeyOf key_of) {
    return {std::ranges::lower_bound(sorted, key, {}, key_of), std::ranges::upper_bound(sorted, key, {}, key_of)};
}

// A coarse grid over the chain, in which boxes are marked.
class MarkedBoxes {
  public:
    explicit MarkedBoxes(const Bounds& all) : low_(all.low), marks_(cells * cells * cells, 0) {
        const glm::vec3 extent = all.extent();
        scale_ = static_cast<float>(cells) / (std::max({extent.x, extent.y, extent.z}) + 1);
    }
    void mark(const Bounds& box) {
        for_each_cell(box, [&](std::size_t cell) { marks_[cell] = 1; });
    }
    bool meets(const Bounds& box) const {
        bool is_marked = false;
        for_each_cell(box, [&](std::size_t cell) { is_marked = is_marked || marks_[cell] != 0; });
        return is_marked;
    }

  private:
    static constexpr std::size_t cells = 128;
    template <class F>
    void for_each_cell(const Bounds& box, const F& f) const {
        std::array<std::size_t, 3> first, last;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto k = static_cast<int>(i);
            const auto cell = [&](float x) {
                const float at = std::clamp((x - low_[k]) * scale_, 0.f, static_cast<float>(cells - 1));
                return static_cast<std::size_t>(at);
            };
            first[i] = cell(box.low[k]);
            last[i] = cell(box.high[k]);
        }
        for (std::size_t x = first[0]; x <= last[0]; ++x)
            for (std::size_t y = first[1]; y <= last[1]; ++y)
                for (std::size_t z = first[2]; z <= last[2]; ++z) f((x * cells + y) * cells + z);
    }

    glm::vec3 low_;
    float scale_;
    std::vector<char> marks_;
};

// Where an edge is divided: the position along it, and the vertex.
struct Divider {
    std::uint32_t a, b;
    double along;
    std::uint32_t vertex;
    auto key() const { return std::tie(a, b, along, vertex); }
};
struct Inner {
    std::uint32_t triangle, vertex;
    auto operator<=>(const Inner&) const = default;
};
struct Segment {
    std::uint32_t triangle, from, to;
    auto operator<=>(const Segment&) const = default;
};

class Arrangement {
  public:
    Arrangement(Chain& chain, const std::string& name)
        : chain_(chain), name_(name), vertex_at_(chain), most_triangles_(4 * chain.triangles.size() + 1'000'000) {}

    std::vector<std::uint32_t> run() {
        vertex_at_.join_touching();
        merge_equal(chain_.triangles);
        is_new_.assign(chain_.triangles.size(), 1);
        constexpr int most_rounds = 24, least_rounds = 6;
        constexpr std::size_t few = 10'000;
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        for (int round = 0; round < most_rounds; ++round) {
            const std::optional<Contacts> found = find();
            if (!found) break;
            const Contacts& contacts = *found;
            const std::size_t count = contacts.edges.size() + contacts.faces.size();
            if (count == 0) return {};
            if (round >= least_rounds && count > 2 * fewest) break;
            if (count > few && count > 16 * fewest) break;
            fewest = std::min(fewest, count);
            try {
                if (!divide(contacts)) break;
            } catch (const Subdivision::Tangled&) {
                break;  // before triangles were changed
            }
        }
        std::vector<std::uint32_t> touching_others;
        for (std::uint32_t t = 0; t < is_new_.size(); ++t)
            if (is_new_[t]) touching_others.push_back(t);
        return touching_others;
    }

  private:
    // All contacts of new triangles; nullopt if there are too many. If surfaces coincide within rounding, their parts
    // get thinner from round to round, and each part meets more and more others.
    std::optional<Contacts> find() {
        const std::size_t n = chain_.triangles.size();
        std::vector<std::uint32_t> fresh;
        Bounds all;
        for (std::uint32_t t = 0; t < n; ++t) {
            all = unite(all, chain_.box(t));
            if (is_new_[t]) fresh.push_back(t);
        }
        if (fresh.empty()) return Contacts();
        std::vector<std::uint32_t> near = fresh;
        if (fresh.size() < n) {
            MarkedBoxes marked(all);
            for (const std::uint32_t t : fresh) marked.mark(chain_.box(t).inflated(margin));
            for (std::uint32_t t = 0; t < n; ++t)
                if (!is_new_[t] && marked.meets(chain_.box(t))) near.push_back(t);
        }
        std::vector<Bounds> boxes;
        for (const std::uint32_t t : near) boxes.push_back(chain_.box(t).inflated(margin));
        const BoxTree tree(boxes, 4);
        constexpr std::size_t in_chunk = 1024;
        std::vector<Contacts> found((fresh.size() + in_chunk - 1) / in_chunk);
        std::atomic<std::uint64_t> steps = 0, contacts = 0;
        const std::uint64_t most_steps = work_.left(), most_contacts = 16 * std::uint64_t{n} + 1'000'000;
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
            const std::size_t end = std::min((chunk + 1) * in_chunk, fresh.size());
            for (std::size_t i = chunk * in_chunk; i < end && steps <= most_steps && contacts <= most_contacts; ++i) {
                const std::size_t before = found[chunk].size();
                steps += contacts_of(i, near, boxes, tree, found[chunk]);
                contacts += found[chunk].size() - before;
            }
        });
        work_.pay(steps);
        if (contacts > most_contacts) return std::nullopt;
        Contacts result;
        for (Contacts& c : found) {
            result.edges.insert(result.edges.end(), c.edges.begin(), c.edges.end());
            result.faces.insert(result.faces.end(), c.faces.begin(), c.faces.end());
            result.segments.insert(result.segments.end(), c.segments.begin(), c.segments.end());
            c = {};
        }
        return result;
    }
    // The contacts of near[i], which is new, with later triangles. Returns the cost.
    std::uint64_t contacts_of(std::size_t i, std::span<const std::uint32_t> near, std::span<const Bounds> boxes,
                              const BoxTree& tree, Contacts& found) const {
        constexpr std::uint64_t steps_of_pair = 4;
        std::uint64_t steps = 0;
        const auto overlap = [&](const Bounds& box) { return !intersect(box, boxes[i]).empty(); };
        find_own_contact(chain_, near[i], found);
        tree.for_each_leaf(overlap, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t k = first; k < first + count; ++k) {
                const std::uint32_t other = tree.order[k];
                if (other <= i || !overlap(boxes[other])) continue;
                steps += steps_of_pair;
                find_contacts(chain_, near[i], near[other], found);
            }
        });
        return steps + 1;
    }

    // Returns false if nothing had to be divided.
    bool divide(const Contacts& contacts) {
        const std::vector<Divider> dividers = dividers_of(contacts.edges);
        std::vector<Inner> inner;
        for (const FaceContact& f : sorted(contacts.faces)) inner.push_back({f.triangle, vertex_at_(f.at)});
        std::ranges::sort(inner);
        const std::vector<Segment> segments = segments_of(contacts.segments);
        std::vector<char> has_divider(chain_.points.size(), 0);
        for (const Divider& d : dividers) has_divider[d.a] = has_divider[d.b] = 1;

        const std::size_t n = chain_.triangles.size();
        std::vector<std::vector<ChainTriangle>> parts(n);
        tbb::parallel_for(std::size_t{0}, n, [&](std::size_t t) {
            const auto& c = chain_.triangles[t].corners;
            const auto within = with_key(inner, static_cast<std::uint32_t>(t), &Inner::triangle);
            if (within.empty() && has_divider[c[0]] + has_divider[c[1]] + has_divider[c[2]] < 2) return;
            const auto along = with_key(segments, static_cast<std::uint32_t>(t), &Segment::triangle);
            parts[t] = divided(chain_.triangles[t], dividers, within, along);
        });
        std::vector<ChainTriangle> result;
        std::vector<char> is_new;
        bool is_any = false;
        for (std::size_t t = 0; t < n; ++t)
            if (parts[t].empty()) {
                result.push_back(chain_.triangles[t]);
                is_new.push_back(0);
            } else {
                is_any = true;
                for (const ChainTriangle& part : parts[t]) {
                    const auto& c = part.corners;
                    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
                    result.push_back(part);
                    is_new.push_back(1);
                }
            }
        chain_.triangles = std::move(result);
        is_new_ = std::move(is_new);
        if (is_any) merge();
        if (chain_.triangles.size() > most_triangles_)
            throw ModelError(
                fmt::format("mesh: {} crosses itself so often that its parts are more than {} triangles: simplify it",
                            name_, most_triangles_));
        return is_any;
    }
    static std::vector<FaceContact> sorted(std::vector<FaceContact> faces) {
        std::ranges::sort(faces, {}, [](const FaceContact& f) { return std::tuple(f.triangle, key_of(f.at)); });
        return faces;
    }
    std::vector<Segment> segments_of(std::span<const SegmentContact> contacts) {
        std::vector<Segment> segments;
        for (const SegmentContact& c : contacts) {
            const std::uint32_t a = vertex_at_(c.from), b = vertex_at_(c.to);
            segments.push_back({c.triangle, std::min(a, b), std::max(a, b)});
        }
        tbb::parallel_sort(segments.begin(), segments.end());
        segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
        return segments;
    }
    std::vector<Divider> dividers_of(std::vector<EdgeContact> contacts) {
        tbb::parallel_sort(contacts.begin(), contacts.end(), [](const EdgeContact& x, const EdgeContact& y) {
            return std::tuple(x.a, x.b, key_of(x.at)) < std::tuple(y.a, y.b, key_of(y.at));
        });
        std::vector<Divider> dividers;
        for (const EdgeContact& c : contacts) {
            const std::uint32_t v = vertex_at_(c.at);
            const glm::dvec3 a = chain_.points[c.a], e = chain_.points[c.b] - a;
            const double along = glm::dot(chain_.points[v] - a, e) / glm::dot(e, e);
            if (v == c.a || v == c.b || !(along > 0 && along < 1)) continue;
            if (dividers.empty() || dividers.back().a != c.a || dividers.back().b != c.b || dividers.back().vertex != v)
                dividers.push_back({c.a, c.b, along, v});
        }
        std::ranges::sort(dividers, [](const Divider& x, const Divider& y) { return x.key() < y.key(); });
        return dividers;
    }
    // The parts of a triangle; empty if it is not divided.
    std::vector<ChainTriangle> divided(const ChainTriangle& t, const std::vector<Divider>& dividers,
                                       std::span<const Inner> within, std::span<const Segment> along) const {
        Subdivision parts(chain_.points, t.corners);
        std::vector<std::uint32_t> present(t.corners.begin(), t.corners.end());
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t a = t.corners[side], b = t.corners[(side + 1) % 3];
            std::vector<std::uint32_t> on_side;
            for (const Divider& d : with_key(dividers, std::pair(std::min(a, b), std::max(a, b)),
                                             [](const Divider& divider) { return std::pair(divider.a, divider.b); }))
                on_side.push_back(d.vertex);
            if (a > b) std::ranges::reverse(on_side);
            parts.add_on_side(side, on_side);
            present.insert(present.end(), on_side.begin(), on_side.end());
        }
        for (const Inner& i : within) {
            if (std::ranges::find(present, i.vertex) != present.end()) continue;
            present.push_back(i.vertex);
            parts.add_within(i.vertex);
        }
        if (present.size() == 3) return {};
        for (const Segment& s : along) parts.add_segment(s.from, s.to);
        std::vector<ChainTriangle> result;
        for (const Subdivision::Corners& c : parts.triangles()) result.push_back({c, t.times});
        return result;
    }

    // Adds up equal triangles, of which at least one is new, and puts corners in ascending order.
    void merge() {
        std::vector<char> is_touched(chain_.points.size(), 0);
        for (std::size_t t = 0; t < is_new_.size(); ++t)
            if (is_new_[t])
                for (const std::uint32_t v : chain_.triangles[t].corners) is_touched[v] = 1;
        std::vector<ChainTriangle> old, touched;
        for (std::size_t t = 0; t < is_new_.size(); ++t) {
            const ChainTriangle& triangle = chain_.triangles[t];
            if (is_new_[t]) {
                touched.push_back(triangle);
            } else {
                old.push_back(triangle);
            }
        }
        std::vector<ChainTriangle> equal;
        std::erase_if(old, [&](const ChainTriangle& t) {
            if (!is_touched[t.corners[0]] || !is_touched[t.corners[1]] || !is_touched[t.corners[2]]) return false;
            equal.push_back(t);
            return true;
        });
        touched.insert(touched.end(), equal.begin(), equal.end());
        merge_equal(touched);
        is_new_.assign(old.size(), 0);
        is_new_.resize(old.size() + touched.size(), 1);
        old.insert(old.end(), touched.begin(), touched.end());
        chain_.triangles = std::move(old);
    }

    static constexpr float margin = static_cast<float>(touching);

    Chain& chain_;
    const std::string& name_;
    VertexAt vertex_at_;
    std::size_t most_triangles_;
    model::Preparation work_{"mesh"};
    std::vector<char> is_new_;
};

}  // namespace

std::vector<std::uint32_t> arrange(Chain& chain, const std::string& name) {
    return Arrangement(chain, name).run();
}

}  // namespace phasetree::mesh
