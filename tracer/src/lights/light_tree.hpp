// A tree over lamps, because evaluating every one of many lamps is too slow. It groups lamps into clusters, and
// clusters into larger ones. Choosing a lamp, or finding those that a ray may hit, then visits a few dozen nodes.
//
// A lamp is an area light, a point light, or a part of an emissive surface or medium. Once lamps are clustered, there
// are at most `most_roots` roots, each a cluster or a lamp; before that, every lamp is a root. A root is chosen among
// all roots. From there, one of the two members of each cluster is chosen, nearly in proportion to their light at the
// receiver. The caller provides the light of a node; that of clusters is received(). The probability below the root is
// the product along the path.
//
// Clusters are split where the sum of intensity · area · cone measure of both halves is least, with a penalty for thin
// ones: A. Conty Estevez, C. Kulla: Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG 2018.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

#include "lights/emission_bounds.hpp"

namespace phasetree::tracer {

/// A lamp, by its number among the lamps of its kind, or a cluster, by its number in the tree.
struct LightNode {
    enum class Kind : std::uint32_t { area, point, emissive_part, cluster };

    Kind kind = Kind::area;
    std::uint32_t number = 0;
    auto operator<=>(const LightNode&) const = default;
};

class LightTree {
  public:
    struct Lamp {
        LightNode node;
        EmissionBounds bounds;
    };
    /// The maximum number of roots once lamps are clustered. Up to this many lamps are all roots.
    static constexpr std::size_t most_roots = 32;

    /// Adds the next lamp of its kind, and dissolves all clusters.
    void add(LightNode::Kind kind);
    /// Clusters the lamps. The numbers of each kind start at 0 and have no gaps.
    static LightTree of(std::span<const Lamp> lamps);

    /// The nodes among which a choice starts, in the order of LightNode::Kind and then of their numbers. Each lamp is a
    /// root or below exactly one.
    std::span<const LightNode> roots() const { return roots_; }

    /// The light of a cluster, see EmissionBounds::received(), clamped to single precision.
    float received(std::uint32_t cluster, const LightReceiver& at) const {
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(std::min(clusters_[cluster].bounds.received(at), most));
    }
    const BoundingSphere& sphere(std::uint32_t cluster) const { return clusters_[cluster].bounds.sphere; }
    std::span<const LightNode, 2> members(std::uint32_t cluster) const { return clusters_[cluster].members; }

    struct Choice {
        LightNode lamp;
        float probability;  ///< with which choose() reaches it from the node
        float u;            ///< u, rescaled to [0, 1) within the part of it that led here
    };
    /// Chooses a lamp below a node by u in [0, 1). given(node) returns the light of a node. Returns nullopt where the
    /// light of both members of a cluster is 0, or overflows a float.
    template <class Given>
    std::optional<Choice> choose(LightNode node, float u, const Given& given) const;

    struct Reached {
        std::size_t root;   ///< its number in roots()
        float probability;  ///< with which choose() reaches the lamp from that root
    };
    /// The root above a lamp, and the probability with which choose() reaches the lamp from it.
    template <class Given>
    Reached path_to(LightNode lamp, const Given& given) const;

    /// Calls use(lamp) for every area light and emissive part that the ray may hit nearer than `farthest()`, and for
    /// some others. `farthest()` may decrease with each call. The direction has unit length.
    template <class Farthest, class Use>
    void for_each_maybe_hit(const glm::vec3& origin, const glm::vec3& direction, const Farthest& farthest,
                            const Use& use) const;

    /// As above, for everything that the ray may hit, with the path to each lamp: calls use(lamp, path), where path()
    /// is path_to(lamp, given), except for rounding. The light of a cluster is computed once for all lamps below.
    template <class Given, class Use>
    void for_each_maybe_hit_with_path(const glm::vec3& origin, const glm::vec3& direction, const Given& given,
                                      const Use& use) const;

  private:
    struct Cluster {
        EmissionBounds bounds;
        std::array<LightNode, 2> members;
    };
    class Builder;

    /// If either member is a cluster, whose light is only estimated, no member with light is chosen with a smaller
    /// probability than this.
    static constexpr float least_probability = 1.0f / 256;

    /// The probability of a cluster's first member; nullopt if the light of both is 0 or overflows a float.
    template <class Given>
    std::optional<float> first_probability(std::uint32_t cluster, const Given& given) const;

    /// Index of a lamp or cluster in one sequence, in the order of LightNode::Kind.
    std::size_t index_of(const LightNode& node) const {
        const auto kind = static_cast<std::ptrdiff_t>(node.kind);
        return std::accumulate(lamps_.begin(), lamps_.begin() + kind, std::size_t(0)) + node.number;
    }
    /// A node on the path from a root, and the results of choose() for it.
    struct Step {
        const Step* before = nullptr;  ///< the cluster that contains it; null for a root
        LightNode node{};
        mutable std::optional<float> probability{};                       ///< of reaching it from the root
        mutable std::optional<std::optional<float>> first_probability{};  ///< of a cluster; unset until it is computed
    };
    template <class Given>
    float probability_of(const Step& step, const Given& given) const;

    void roots_are_all_lamps();
    bool may_hit(const glm::vec3& origin, const glm::vec3& direction, float farthest, std::uint32_t cluster) const;

    std::array<std::uint32_t, 3> lamps_{};  ///< number of lamps of each kind
    std::vector<LightNode> roots_;
    std::vector<Cluster> clusters_;
    std::vector<std::optional<std::uint32_t>> parent_;  ///< the cluster above a node, by index_of(); nullopt for a root
};

template <class Given>
std::optional<float> LightTree::first_probability(std::uint32_t cluster, const Given& given) const {
    const auto& [first, second] = clusters_[cluster].members;
    const float of_first = given(first), of_second = given(second), total = of_first + of_second;
    if (!(total > 0.0f) || total > std::numeric_limits<float>::max()) return std::nullopt;
    const bool has_estimate = first.kind == LightNode::Kind::cluster || second.kind == LightNode::Kind::cluster;
    if (!has_estimate || of_first == 0.0f || of_second == 0.0f) return of_first / total;
    return std::clamp(of_first / total, least_probability, 1.0f - least_probability);
}

template <class Given>
std::optional<LightTree::Choice> LightTree::choose(LightNode node, float u, const Given& given) const {
    float probability = 1.0f;
    while (node.kind == LightNode::Kind::cluster) {
        const std::optional<float> first = first_probability(node.number, given);
        if (!first) return std::nullopt;
        const bool is_first = u < *first;
        const float chosen = is_first ? *first : 1.0f - *first;
        u = std::clamp((is_first ? u : u - *first) / chosen, 0.0f, 0x1.fffffep-1f);
        probability *= chosen;
        node = members(node.number)[is_first ? 0 : 1];
    }
    return Choice{node, probability, u};
}

template <class Given>
LightTree::Reached LightTree::path_to(LightNode lamp, const Given& given) const {
    float probability = 1.0f;
    LightNode node = lamp;
    while (!parent_.empty() && parent_[index_of(node)]) {
        const std::uint32_t cluster = *parent_[index_of(node)];
        const std::optional<float> first = first_probability(cluster, given);
        probability *= !first ? 0.0f : node == members(cluster)[0] ? *first : 1.0f - *first;
        node = {LightNode::Kind::cluster, cluster};
    }
    return {static_cast<std::size_t>(std::ranges::find(roots_, node) - roots_.begin()), probability};
}

template <class Farthest, class Use>
void LightTree::for_each_maybe_hit(const glm::vec3& origin, const glm::vec3& direction, const Farthest& farthest,
                                   const Use& use) const {
    const auto visit = [&](const auto& self, const LightNode& node) -> void {
        if (node.kind == LightNode::Kind::area || node.kind == LightNode::Kind::emissive_part) use(node);
        if (node.kind != LightNode::Kind::cluster || !may_hit(origin, direction, farthest(), node.number)) return;
        for (const LightNode& member : members(node.number)) self(self, member);
    };
    for (const LightNode& root : roots_) visit(visit, root);
}

template <class Given>
float LightTree::probability_of(const Step& step, const Given& given) const {
    if (step.probability) return *step.probability;
    if (!step.before) return 1.0f;
    const Step& before = *step.before;
    if (!before.first_probability) before.first_probability = first_probability(before.node.number, given);
    const std::optional<float>& first = *before.first_probability;
    const bool is_first = step.node == members(before.node.number)[0];
    step.probability = !first ? 0.0f : probability_of(before, given) * (is_first ? *first : 1.0f - *first);
    return *step.probability;
}

template <class Given, class Use>
void LightTree::for_each_maybe_hit_with_path(const glm::vec3& origin, const glm::vec3& direction, const Given& given,
                                             const Use& use) const {
    constexpr float everywhere = std::numeric_limits<float>::infinity();
    const auto visit = [&](const auto& self, std::size_t root, const Step& step) -> void {
        const LightNode& node = step.node;
        if (node.kind == LightNode::Kind::area || node.kind == LightNode::Kind::emissive_part)
            use(node, [&] { return Reached{root, probability_of(step, given)}; });
        if (node.kind != LightNode::Kind::cluster || !may_hit(origin, direction, everywhere, node.number)) return;
        for (const LightNode& member : members(node.number)) self(self, root, Step{&step, member});
    };
    for (std::size_t root = 0; root < roots_.size(); ++root) visit(visit, root, Step{nullptr, roots_[root]});
}

}  // namespace phasetree::tracer
