#pragma once

/// Random trees for the tests over all nodes. They come from the node lists and the nodes' own lists of parameters, so
/// a new node is drawn, as a root and as a child, without a line here. Parameters that a node's prepare() rejects are
/// drawn again. A tree depends on a single number of the generator, and each child on a single number of its parent.
/// The choice of a node depends on names instead of positions in lists. So a new node replaces others in some trees,
/// and changes nothing else.
///
/// The values keep an object about a metre large. A third of them are multiples of a quarter: coincident faces, equal
/// radii, zero angles and exact ties are where sign errors and missing cases hide.

#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>

#include "phasetree/math/bounds.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree_support/split_mix64.hpp"
#include "support/long_tests.hpp"

namespace phasetree::tests {

/// The same numbers with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}

    std::uint64_t bits() { return generator_(); }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    float uniform(float low, float high) { return low + (high - low) * static_cast<float>(unit()); }
    int below(int n) { return static_cast<int>(unit() * n); }
    bool chance(double p) { return unit() < p; }
    glm::vec3 in(const Bounds& b) {
        const float x = uniform(b.low.x, b.high.x), y = uniform(b.low.y, b.high.y), z = uniform(b.low.z, b.high.z);
        return {x, y, z};
    }
    /// Uniform on the unit sphere.
    glm::vec3 direction() {
        const double z = 2 * unit() - 1, a = 6.283185307179586 * unit(), r = std::sqrt(1 - z * z);
        return glm::vec3(glm::normalize(glm::dvec3(r * std::cos(a), r * std::sin(a), z)));
    }

  private:
    support::SplitMix64 generator_;
};

/// Depth 1 is a primitive; for an object, a primitive with a phase.
Field random_field(Random&, int depth);
Phased random_object(Random&, int depth);

/// The phases that random objects use are 1 … this.
inline constexpr int random_phases = 4;

/// A kind of node of the lists, and how one is drawn.
struct NodeKind {
    std::string_view name;
    bool is_field;
    /// One random tree with a node of this kind at its root. For the kind of a field, a `set` with phase 1 is above it.
    Phased (*object)(Random&, int depth);
    Field (*field)(Random&, int depth);  ///< null for objects' kinds
};
std::span<const NodeKind> node_kinds();
/// Random numbers for drawing trees of one kind; they do not depend on the kinds before it.
Random random_for(std::uint64_t seed, const NodeKind&);
/// The kind of objects with this name.
const NodeKind& object_kind(std::string_view name);

/// The box in which to sample an object: its bounds, enlarged; if it is unbounded, a part around the origin.
inline Bounds region_of_interest(const Bounds& b) {
    const Bounds near = intersect(b, Bounds::centred(glm::vec3(3)));
    return near.empty() ? Bounds::centred(glm::vec3(1)) : near.inflated(0.1f + 0.1f * near.diagonal());
}

}  // namespace phasetree::tests
