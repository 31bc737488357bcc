#include "nodes/mesh_repair/arrange.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
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
    Arrangement(Chain& chain, const std::string& name, model::Preparation& work)
        : chain_(chain),
          name_(name),
          work_(work),
          vertex_at_(chain),
          most_triangles_(4 * chain.triangles.size() + 1'000'000) {}

    std::vector<std::uint32_t> run() {
        vertex_at_.join_touching();
        merge_equal(chain_.triangles);
        is_new_.assign(chain_.triangles.size(), 1);
        constexpr int most_rounds = 24, least_rounds = 6, joining_from = 3, accepting_from = 10;
        constexpr std::size_t few = 10'000;
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        for (int round = 0; round < most_rounds; ++round) {
            const std::optional<Contacts> found = find(round >= accepting_from);
            if (!found) break;
            const Contacts& contacts = *found;
            const std::size_t count = contacts.edges.size() + contacts.faces.size();
            if (count == 0 && !has_accepted_) return {};
            if (count == 0) break;
            if (count > few && count > (round >= least_rounds ? 2 : 16) * fewest) break;
            fewest = std::min(fewest, count);
            try {
                const bool has_joined = round >= joining_from && join_close(contacts);
                if (!has_joined && !divide(contacts)) break;
            } catch (const Subdivision::Tangled&) {
                break;  // before triangles were changed
            }
        }
        // A thin triangle that was accepted may hide a crossing, which can shift the winding numbers of everything
        // beyond it. So others are returned, too.
        constexpr std::size_t samples = 20'000;
        const std::size_t every = has_accepted_ ? is_new_.size() / samples + 1 : is_new_.size() + 1;
        std::vector<std::uint32_t> touching_others;
        for (std::uint32_t t = 0; t < is_new_.size(); ++t)
            if (is_new_[t] || t % every == every - 1) touching_others.push_back(t);
        return touching_others;
    }

  private:
    // All contacts of new triangles; nullopt if there are too many. If surfaces coincide within rounding, their parts
    // get thinner from round to round, and each part meets more and more others.
    std::optional<Contacts> find(bool accepts_thin) {
        const auto n = static_cast<std::uint32_t>(chain_.triangles.size());
        std::vector<std::uint32_t> fresh;
        for (std::uint32_t t = 0; t < n; ++t)
            if (is_new_[t]) fresh.push_back(t);
        if (fresh.empty()) return Contacts();
        std::vector<std::uint32_t> near = fresh;
        if (fresh.size() < n) add_triangles_near(fresh, near);
        std::vector<Bounds> boxes(near.size());
        tbb::parallel_for(std::size_t{0}, near.size(),
                          [&](std::size_t i) { boxes[i] = chain_.box(near[i]).inflated(margin); });
        const BoxTree tree(boxes, 4);
        constexpr std::size_t in_chunk = 1024;
        std::vector<Contacts> found((fresh.size() + in_chunk - 1) / in_chunk);
        std::atomic<std::uint64_t> steps = 0, contacts = 0;
        const std::uint64_t most_steps = work_.left(), most_contacts = 16 * std::uint64_t{n} + 1'000'000;
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
            work_.poll();
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
        has_accepted_ = accepts_thin && accept_thin(near, result);
        return result;
    }
    // Of two thin triangles that form a quadrilateral, each may have a corner that touches the opposite edge, and so
    // may the other two that replace them when these edges are divided: for ever. So after some rounds, such triangles
    // stay: the contacts of their own corners and edges are removed. Returns whether there are any.
    bool accept_thin(std::span<const std::uint32_t> near, Contacts& contacts) const {
        constexpr double least_height = 1;
        using Thin = std::tuple<std::uint32_t, std::uint32_t, std::array<double, 3>>;
        const auto contact_of = [](const EdgeContact& c) { return Thin(c.a, c.b, key_of(c.at)); };
        Contacts own;
        for (const std::uint32_t t : near) {
            const std::size_t before = own.edges.size();
            find_own_contact(chain_, t, own);
            if (own.edges.size() == before) continue;
            const EdgeContact& c = own.edges.back();
            if (glm::length(chain_.normal(t)) < least_height * glm::distance(chain_.points[c.a], chain_.points[c.b]))
                own.edges.pop_back();
        }
        std::vector<Thin> thin;
        for (const EdgeContact& c : own.edges) thin.push_back(contact_of(c));
        std::ranges::sort(thin);
        std::erase_if(contacts.edges,
                      [&](const EdgeContact& c) { return std::ranges::binary_search(thin, contact_of(c)); });
        return !thin.empty();
    }
    // Adds the triangles that are not new and may touch one that is.
    void add_triangles_near(const std::vector<std::uint32_t>& fresh, std::vector<std::uint32_t>& near) const {
        Bounds all;
        for (const std::uint32_t t : fresh) all = unite(all, chain_.box(t).inflated(margin));
        MarkedBoxes marked(all);
        for (const std::uint32_t t : fresh) marked.mark(chain_.box(t).inflated(margin));
        std::vector<char> is_near(is_new_.size(), 0);
        tbb::parallel_for(std::size_t{0}, is_new_.size(), [&](std::size_t t) {
            if (is_new_[t]) return;
            const Bounds box = chain_.box(t);
            is_near[t] = !intersect(box, all).empty() && marked.meets(box);
        });
        for (std::uint32_t t = 0; t < is_near.size(); ++t)
            if (is_near[t]) near.push_back(t);
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

    // Dividing an edge at a vertex close to one of its ends can lead to another such edge, again and again. So joins
    // these vertices to the ends. Returns false if there are none.
    bool join_close(const Contacts& contacts) {
        constexpr double close = 3 * touching;
        std::vector<std::uint32_t> target(chain_.points.size());
        std::iota(target.begin(), target.end(), 0u);
        std::vector<char> is_joined(target.size(), 0);
        bool is_any = false;
        for (const EdgeContact& c : contacts.edges) {
            const std::optional<std::uint32_t> v = vertex_at_.at(c.at);
            for (const std::uint32_t end : {c.a, c.b}) {
                if (!v || *v == end || is_joined[*v] || is_joined[end] ||
                    glm::distance(chain_.points[*v], chain_.points[end]) > close)
                    continue;
                target[std::max(*v, end)] = std::min(*v, end);
                vertex_at_.remove(std::max(*v, end));
                is_joined[*v] = is_joined[end] = 1;
                is_any = true;
            }
        }
        if (!is_any) return false;
        std::vector<ChainTriangle> changed;
        for (std::size_t t = 0; t < is_new_.size(); ++t) {
            ChainTriangle moved = chain_.triangles[t];
            for (std::uint32_t& v : moved.corners) v = target[v];
            if (is_new_[t] == 0 && moved.corners == chain_.triangles[t].corners) continue;
            if (!is_degenerate(moved)) changed.push_back(moved);
            chain_.triangles[t].times = 0;
        }
        merge(std::move(changed));
        return true;
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

        std::vector<std::uint32_t> met;
        for (const Inner& i : inner) met.push_back(i.triangle);
        for (std::uint32_t t = 0; t < chain_.triangles.size(); ++t) {
            const auto& c = chain_.triangles[t].corners;
            if (has_divider[c[0]] + has_divider[c[1]] + has_divider[c[2]] >= 2) met.push_back(t);
        }
        std::ranges::sort(met);
        met.erase(std::unique(met.begin(), met.end()), met.end());
        std::vector<std::vector<ChainTriangle>> parts(met.size());
        tbb::parallel_for(std::size_t{0}, met.size(), [&](std::size_t i) {
            work_.poll();
            const auto within = with_key(inner, met[i], &Inner::triangle);
            const auto along = with_key(segments, met[i], &Segment::triangle);
            parts[i] = divided(chain_.triangles[met[i]], dividers, within, along);
        });
        std::vector<ChainTriangle> added;
        bool is_any = false;
        std::fill(is_new_.begin(), is_new_.end(), 0);
        for (std::size_t i = 0; i < met.size(); ++i) {
            if (parts[i].empty()) continue;
            is_any = true;
            chain_.triangles[met[i]].times = 0;
            for (const ChainTriangle& part : parts[i])
                if (!is_degenerate(part)) added.push_back(part);
        }
        merge(std::move(added));
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

    static bool is_degenerate(const ChainTriangle& t) {
        return t.corners[0] == t.corners[1] || t.corners[1] == t.corners[2] || t.corners[2] == t.corners[0];
    }

    // Removes triangles that count zero times, and adds new ones, whose corners are put in ascending order. Adds up
    // equal triangles, which are new then.
    void merge(std::vector<ChainTriangle> added) {
        std::vector<char> is_touched(chain_.points.size(), 0);
        for (const ChainTriangle& t : added)
            for (const std::uint32_t v : t.corners) is_touched[v] = 1;
        std::erase_if(chain_.triangles, [&](const ChainTriangle& t) {
            if (t.times == 0) return true;
            if (!is_touched[t.corners[0]] || !is_touched[t.corners[1]] || !is_touched[t.corners[2]]) return false;
            added.push_back(t);
            return true;
        });
        merge_equal(added);
        is_new_.assign(chain_.triangles.size(), 0);
        is_new_.resize(chain_.triangles.size() + added.size(), 1);
        chain_.triangles.insert(chain_.triangles.end(), added.begin(), added.end());
    }

    static constexpr float margin = static_cast<float>(touching);

    Chain& chain_;
    const std::string& name_;
    model::Preparation& work_;
    VertexAt vertex_at_;
    std::size_t most_triangles_;
    bool has_accepted_ = false;  // thin triangles, in the last round
    std::vector<char> is_new_;
};

}  // namespace

std::vector<std::uint32_t> arrange(Chain& chain, const std::string& name, model::Preparation& work) {
    return Arrangement(chain, name, work).run();
}

}  // namespace phasetree::mesh
