#include "nodes/mesh_repair/shells.hpp"

#include <algorithm>
#include <numeric>

#include "math/disjoint_sets.hpp"
#include "nodes/mesh_repair/chain_winding.hpp"

namespace phasetree::mesh {

namespace {

// Disjoint sets of triangles that also store, for each triangle, whether it faces the opposite way to its set's root.
class OrientedSets {
  public:
    explicit OrientedSets(std::size_t n) : parent_(n), turned_(n, 0) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    std::pair<std::uint32_t, bool> root(std::uint32_t i) {
        std::uint32_t top = i;
        bool turned = false;
        while (parent_[top] != top) {
            turned ^= turned_[top] != 0;
            top = parent_[top];
        }
        // Shorten the path.
        bool left = turned;
        while (parent_[i] != top && i != top) {
            const bool own = turned_[i] != 0;
            const std::uint32_t next = parent_[i];
            turned_[i] = left;
            parent_[i] = top;
            left ^= own;
            i = next;
        }
        return {top, turned};
    }
    // Joins two triangles. `is_opposite` says whether one of them has to be turned for both to face the same way. A
    // contradiction to what is already known is ignored.
    void join(std::uint32_t a, std::uint32_t b, bool is_opposite) {
        const auto [p, p_turned] = root(a);
        const auto [q, q_turned] = root(b);
        if (p == q) return;
        parent_[std::max(p, q)] = std::min(p, q);
        turned_[std::max(p, q)] = is_opposite ^ p_turned ^ q_turned;
    }

  private:
    std::vector<std::uint32_t> parent_;
    std::vector<char> turned_;
};

// Six times the volume that each shell encloses.
std::vector<double> volumes_of(const Chain& chain, std::span<const std::uint32_t> shells) {
    std::vector<double> volumes;
    std::vector<glm::dvec3> origins;
    for (std::size_t t = 0; t < chain.triangles.size(); ++t) {
        const std::uint32_t s = shells[t];
        if (s >= volumes.size()) volumes.resize(s + 1, 0), origins.resize(s + 1, glm::dvec3(0));
        if (volumes[s] == 0) origins[s] = chain.corner(t, 0);
    }
    for (std::size_t t = 0; t < chain.triangles.size(); ++t)
        volumes[shells[t]] +=
            chain.triangles[t].times * glm::dot(chain.corner(t, 0) - origins[shells[t]], chain.normal(t));
    return volumes;
}

void turn(ChainTriangle& t) {
    std::swap(t.corners[1], t.corners[2]);
}

}  // namespace

void orient(Chain& chain, std::vector<EdgeOfChain>& edges) {
    OrientedSets sets(chain.triangles.size());
    for_each_edge(edges, [&](std::span<const EdgeOfChain> uses) {
        if (uses.size() == 2) sets.join(uses[0].triangle, uses[1].triangle, uses[0].is_rising == uses[1].is_rising);
    });
    std::vector<double> balance(chain.triangles.size(), 0);  // area that is not to be turned, less that which is
    for (std::uint32_t t = 0; t < chain.triangles.size(); ++t) {
        const auto [root, is_turned] = sets.root(t);
        balance[root] += (is_turned ? -1 : 1) * glm::length(chain.normal(t));
    }
    std::vector<char> is_to_turn(chain.triangles.size(), 0);
    for (std::uint32_t t = 0; t < chain.triangles.size(); ++t) {
        const auto [root, is_turned] = sets.root(t);
        is_to_turn[t] = is_turned != (balance[root] < 0);
        if (is_to_turn[t]) turn(chain.triangles[t]);
    }
    for (EdgeOfChain& e : edges) e.is_rising ^= is_to_turn[e.triangle] != 0;
}

std::vector<std::uint32_t> shells_of(const Chain& chain, std::span<const EdgeOfChain> edges) {
    DisjointSets sets(chain.triangles.size());
    for_each_edge(edges, [&](std::span<const EdgeOfChain> uses) {
        for (const EdgeOfChain& e : uses) sets.join(uses[0].triangle, e.triangle);
    });
    // A root is the first of its set.
    std::vector<std::uint32_t> shells(chain.triangles.size());
    std::uint32_t count = 0;
    for (std::size_t t = 0; t < shells.size(); ++t) {
        const std::size_t root = sets.root(t);
        shells[t] = root == t ? count++ : shells[root];
    }
    return shells;
}

void turn_shells(Chain& chain, std::span<const std::uint32_t> shells) {
    std::vector<double> volumes = volumes_of(chain, shells);
    if (std::accumulate(volumes.begin(), volumes.end(), 0.0) < 0) {
        for (ChainTriangle& t : chain.triangles) turn(t);
        for (double& v : volumes) v = -v;
    }
    if (std::ranges::none_of(volumes, [](double v) { return v < 0; })) return;
    std::vector<std::uint32_t> by_size(volumes.size()), rank(volumes.size()), first(volumes.size() + 1, 0);
    std::iota(by_size.begin(), by_size.end(), 0u);
    std::ranges::stable_sort(by_size, std::greater{}, [&](std::uint32_t s) { return std::abs(volumes[s]); });
    for (std::uint32_t i = 0; i < by_size.size(); ++i) rank[by_size[i]] = i;
    std::vector<std::uint32_t> members(shells.size());
    for (const std::uint32_t s : shells) ++first[s + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (std::uint32_t t = 0; t < shells.size(); ++t) members[next[shells[t]]++] = t;

    const ChainWinding winding(chain);
    for (const std::uint32_t s : by_size) {
        if (!(volumes[s] < 0)) continue;
        const std::uint32_t count = first[s + 1] - first[s];
        bool is_within = true;
        constexpr std::uint32_t samples = 8;
        for (std::uint32_t i = 0; i < std::min(samples, count) && is_within; ++i) {
            const std::uint32_t t = members[first[s] + i * count / std::min(samples, count)];
            is_within =
                winding.around(chain.middle(t), [&](std::uint32_t u) { return rank[shells[u]] < rank[s]; }) >= 1;
        }
        if (!is_within)
            for (std::uint32_t i = first[s]; i < first[s + 1]; ++i) turn(chain.triangles[members[i]]);
    }
}

}  // namespace phasetree::mesh
