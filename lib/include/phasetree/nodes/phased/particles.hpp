#pragma once

#include "phasetree/nodes/fields/balls.hpp"
#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// Balls of several phases, given as data. Dₖ is the distance to the balls of phase k. A point belongs to the ball with
/// the smallest |p − c| − r. Where two phases overlap, they share the overlap along the surface where their D are
/// equal; for balls of equal size, that is a plane.
///
///     φₖ = max(Dₖ, (Dₖ − min over m ≠ k of Dₘ)/2),    φ₀ = −min over k of Dₖ.
///
/// φₖ is a single operation of the program, nearer(Dₖ, b) = max(Dₖ, (Dₖ − b)/2), with b the minimum of the other D.
/// This allows a pruning rule: its sign depends on both values only where both are negative; elsewhere, it is that of
/// the first.
///
/// Both operands of the maximum are 1-Lipschitz because the D are. For i ≠ k, φᵢ + φₖ is at least the sum of the second
/// operands, (Dᵢ − min over m ≠ i of Dₘ + Dₖ − min over m ≠ k of Dₘ)/2 ≥ (Dᵢ − Dₖ + Dₖ − Dᵢ)/2 = 0. And φ₀ + φₖ ≥ Dₖ −
/// min D ≥ 0.
struct Particles {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "particles", "",
        "φₖ = max(Dₖ, (Dₖ − min over m ≠ k of Dₘ)/2),  φ₀ = −min Dₖ,  Dₖ = min over its balls of |p − c| − r",
        "Up to sixteen million balls of several phases: a packing, a molecule, a foam. Where balls of different phases "
        "overlap, a point belongs to the one with the least |p − c| − r."};

    std::vector<Phase> of_phases{};
    std::vector<glm::vec3> centres{};
    std::vector<float> radii{};
    FromFile<BallList> file{};
    std::vector<Balls> groups{};    ///< derived: the balls of each phase; only their tables and boxes are set
    std::vector<Phase> group_of{};  ///< derived: the phase of each group

    template <class V>
    static void parameters(V&& v) {
        v(&Particles::of_phases,
          Parameter{"phases", "",
                    "With centres: one phase for all balls, or one per ball. With a file: the phases that its column "
                    "`phase` refers to, counted from 0, or one for all."});
        v(&Particles::centres,
          Parameter{"centres", "m", "Centres of the balls, unless they are in a file.", limits::any, true});
        v(&Particles::radii,
          Parameter{"radii", "m", "Radii of the balls: one number for all, or one per centre. A file may have its own.",
                    limits::positive, true, true});
        v(&Particles::file, detail::file_of_balls);
    }
    /// Throws ModelError if parameters are missing or inconsistent.
    void prepare();

    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        Phases<typename D::Scalar> distances;
        for (std::size_t k = 0; k < groups.size(); ++k) distances.set(group_of[k].index, d.primitive(groups[k], p));
        Phases<typename D::Scalar> result;
        std::optional<typename D::Scalar> least;
        for_each_phase(distances.present, [&](int i) { least = least ? min(*least, distances[i]) : distances[i]; });
        detail::minimum_of_others(distances, distances.present, distances.present, [&](int i, const auto& others) {
            result.set(i, others ? nearer(distances[i], *others) : distances[i]);
        });
        result.set(0, -*least);
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(vacuum) | PhaseSet::of(group_of); }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const {
        std::size_t sum = std::span(group_of).size_bytes();
        for (const Balls& group : groups) sum += sizeof group + group.data().size_bytes();
        return sum;
    }
    Bounds bounds(BoundsQuery& q, float level) const;
};

}  // namespace phasetree
