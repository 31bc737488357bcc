// Many lamps in groups, groups in groups: so that to choose one of a thousand, or to find those that a ray meets, a few
// dozen are asked and not all.
//
// A lamp is an area light or a point light. Up to `most_compared` of them are all compared one by one, as exactly as
// can be. More are in a binary tree, of which only the upmost groups are compared. From the chosen one the way leads
// down to a lamp, at each group to one of its two members in proportion to what they give at the receiver. What a group
// gives is estimated (EmissionBounds::received); the caller tells what a lamp gives. The probability with which a lamp
// is chosen is the product of those along the way.
//
// Lamps are divided where the sum of intensity · area · measure of directions of the two groups is least, as in the
// source of emission_bounds.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "lights/emission_bounds.hpp"

namespace phasetree::tracer {

/// An area light or a point light by its number among those, or a group of lamps.
struct LightNode {
    enum class Kind : std::uint32_t { area, point, group };

    Kind kind = Kind::area;
    std::uint32_t number = 0;
    friend bool operator==(const LightNode&, const LightNode&) = default;
};

class LightTree {
  public:
    struct Lamp {
        LightNode node;
        EmissionBounds bounds;
    };
    /// So many lamps, or groups, are all compared with each other.
    static constexpr std::size_t most_compared = 32;

    /// Adds the next lamp of its kind. All lamps are compared one by one from then on.
    void add(LightNode::Kind kind);
    /// Groups the lamps: all area lights in their order, and then all point lights. There must be one at least.
    static LightTree grouped(std::span<const Lamp> lamps);

    /// What is compared: all lamps, area lights first; or the upmost groups.
    std::span<const LightNode> tops() const { return tops_; }

    /// What a group gives, as EmissionBounds::received().
    float received(std::uint32_t group, const LightReceiver& at) const {
        return static_cast<float>(std::min(groups_[group].bounds.received(at), 3e38));
    }
    const BoundingSphere& sphere(std::uint32_t group) const { return groups_[group].bounds.sphere; }
    std::span<const LightNode, 2> members(std::uint32_t group) const { return groups_[group].members; }

    struct Choice {
        LightNode lamp;
        float probability;  ///< of the way down to it
        float u;            ///< what is left of the number that chose it, stretched to [0, 1) again
    };
    /// Chooses a lamp from a node down by u in [0, 1), where given(node) is what a lamp or a group gives. Nothing where
    /// neither member of a group gives anything.
    template <class Given>
    std::optional<Choice> choose(LightNode node, float u, const Given& given) const;

    struct WayDown {
        std::size_t top;    ///< its number among tops()
        float probability;  ///< with which choose() finds the lamp from there
    };
    template <class Given>
    WayDown way_to(LightNode lamp, const Given& given) const;

    /// Calls use(number) for each area light that a ray from the origin in a unit direction may meet.
    template <class Use>
    void for_each_near(const glm::vec3& origin, const glm::vec3& direction, const Use& use) const;

    /// The same by use(number, top, probability), with the number of the top above it, and the probability with which
    /// choose() finds it from there.
    template <class Given, class Use>
    void for_each_near(const glm::vec3& origin, const glm::vec3& direction, const Given& given, const Use& use) const;

  private:
    struct Group {
        EmissionBounds bounds;
        std::array<LightNode, 2> members;
        std::optional<std::uint32_t> above{};  ///< the group of which it is a member, if that is not above the tops
    };
    class Builder;

    /// The probability of the first member of a group; none if neither gives anything. What groups give is an estimate,
    /// so beside them no member that gives something is less likely than this.
    static constexpr float least_probability = 1.0f / 256;
    template <class Given>
    std::optional<float> first_probability(std::uint32_t group, const Given& given) const {
        const float first = given(members(group)[0]), second = given(members(group)[1]), total = first + second;
        if (!(total > 0.0f) || total > std::numeric_limits<float>::max()) return std::nullopt;
        const bool is_estimate =
            members(group)[0].kind == LightNode::Kind::group || members(group)[1].kind == LightNode::Kind::group;
        if (!is_estimate || first == 0.0f || second == 0.0f) return first / total;
        return std::clamp(first / total, least_probability, 1.0f - least_probability);
    }
    bool may_meet(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t group) const;

    std::array<std::uint32_t, 2> lamps_{};  ///< how many area lights and point lights there are
    std::vector<LightNode> tops_;
    std::vector<Group> groups_;
    /// The group of each lamp, by its number among those of its kind; empty if there are no groups.
    std::array<std::vector<std::optional<std::uint32_t>>, 2> above_;
};

template <class Given>
std::optional<LightTree::Choice> LightTree::choose(LightNode node, float u, const Given& given) const {
    float probability = 1.0f;
    while (node.kind == LightNode::Kind::group) {
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
LightTree::WayDown LightTree::way_to(LightNode lamp, const Given& given) const {
    float probability = 1.0f;
    LightNode node = lamp;
    const auto above = [&](const LightNode& n) -> std::optional<std::uint32_t> {
        if (n.kind == LightNode::Kind::group) return groups_[n.number].above;
        const auto& groups = above_[static_cast<std::size_t>(n.kind)];
        return groups.empty() ? std::nullopt : groups[n.number];
    };
    while (const std::optional<std::uint32_t> group = above(node)) {
        const std::optional<float> first = first_probability(*group, given);
        probability *= !first ? 0.0f : node == members(*group)[0] ? *first : 1.0f - *first;
        node = {LightNode::Kind::group, *group};
    }
    return {static_cast<std::size_t>(std::ranges::find(tops_, node) - tops_.begin()), probability};
}

template <class Use>
void LightTree::for_each_near(const glm::vec3& origin, const glm::vec3& direction, const Use& use) const {
    const auto visit = [&](const auto& self, const LightNode& node) -> void {
        if (node.kind == LightNode::Kind::area) use(node.number);
        if (node.kind != LightNode::Kind::group || !may_meet(origin, direction, node.number)) return;
        for (const LightNode& member : members(node.number)) self(self, member);
    };
    for (const LightNode& top : tops_) visit(visit, top);
}

template <class Given, class Use>
void LightTree::for_each_near(const glm::vec3& origin, const glm::vec3& direction, const Given& given,
                              const Use& use) const {
    const auto visit = [&](const auto& self, const LightNode& node, std::size_t top, float probability) -> void {
        if (node.kind == LightNode::Kind::area) use(node.number, top, probability);
        if (node.kind != LightNode::Kind::group || !may_meet(origin, direction, node.number)) return;
        const std::optional<float> first =
            probability > 0.0f ? first_probability(node.number, given) : std::optional<float>();
        self(self, members(node.number)[0], top, first ? probability * *first : 0.0f);
        self(self, members(node.number)[1], top, first ? probability * (1.0f - *first) : 0.0f);
    };
    for (std::size_t top = 0; top < tops_.size(); ++top) visit(visit, tops_[top], top, 1.0f);
}

}  // namespace phasetree::tracer
