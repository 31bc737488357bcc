// Proving: statements about an object that are proved, refuted with points that show it, or left undecided.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "phasetree/measuring/measure.hpp"
#include "phasetree/measuring/node_effects.hpp"

namespace phasetree {

/// The phase is not empty.
struct IsPresent {
    Phase phase;
};
/// The phase is not empty, and in one piece: any two of its points are joined by a path in the phase.
struct IsConnected {
    Phase phase;
};
/// Every path from any of the phases in `inside` to the space around the object crosses one of the phases in `walls`.
/// None of these phases is empty.
struct IsClosed {
    PhaseSet walls, inside;
};
/// Neither phase is empty, they do not touch, and no point of the first is closer than `at_least` to a point of the
/// second.
struct AreApart {
    Phase first, second;
    double at_least = 0;  ///< in the scene's unit of length. Not negative
};
/// The two phases touch somewhere.
struct AreTouching {
    Phase first, second;
};
/// The phase is not empty, and nowhere thinner than `at_least`: every point of it is at most `reach` away from the
/// centre of a ball of this diameter that lies in the phase.
///
/// A reach of half the diameter, the smallest that makes sense, would require each point to be in such a ball. No
/// object with a sharp edge satisfies that. With the default, edges and corners count as thick if they are no sharper
/// than 60 degrees. The price is that a dent narrower than about twice the diameter, or a point where a wall is
/// slightly too thin, may go unnoticed.
struct IsThick {
    Phase phase;
    double at_least = 0;  ///< in the scene's unit of length. Positive
    double reach = 0;     ///< 0 for `at_least`; otherwise more than half of `at_least`
};
/// None of the phases is empty, and the sum of their volumes times their weights is in [at_least, at_most].
struct HasVolume {
    std::vector<std::pair<Phase, double>> weights;  ///< phases, and factors of their volumes, such as densities
    double at_least = 0, at_most = std::numeric_limits<double>::infinity();
};
/// Leaving out any one node of the tree changes the label of some point; see node_effects().
struct HasNoDeadNodes {};
/// The box that follows from the bounds of the tree's nodes is at most `at_most` times as long along each axis as the
/// smallest box around the object. A larger box makes the default resolution of rays and proofs coarser by the same
/// factor.
struct HasTightBounds {
    double at_most = 2;  ///< at least 1
};
using Statement = std::variant<IsPresent, IsConnected, IsClosed, AreApart, AreTouching, IsThick, HasVolume,
                               HasNoDeadNodes, HasTightBounds>;

/// A point, and the phase that is proven to be there.
struct Witness {
    glm::vec3 point;
    Phase phase;
};

/// What is known of a statement.
struct Proof {
    Verdict verdict = Verdict::undecided;
    /// Why, in words, without the names of phases; empty if there is nothing to add.
    std::string reason{};
    /// Points that show the verdict; see prove(). Empty if none are needed, or none are known.
    std::vector<Witness> witnesses{};
    double resolution = 0;            ///< the side of the smallest boxes that were examined
    Measured measured{};              ///< HasVolume: the sum of the volumes times their weights
    std::vector<NodeEffect> nodes{};  ///< HasNoDeadNodes: what is known about each node
};

struct ProveOptions {
    /// The side of the smallest boxes; 0 for 1/256 of the object's longest side. Not negative. Smaller features stay
    /// undecided.
    double resolution = 0;
    double seconds = std::numeric_limits<double>::infinity();  ///< end after this time. Positive
    /// End when more than this many boxes would be needed. Unlike the time, this limit gives equal results on all
    /// machines.
    std::size_t max_boxes = std::size_t{1} << 25;
    std::function<bool()> cancelled{};      ///< polled from any thread; return true to get what is known so far
    std::function<void(float)> progress{};  ///< receives a guess of the share of the work that is done
};

/// Throws ModelError if a statement has invalid phases, or a length out of its range.
void check_statement(const Statement&);

/// Decide statements about an object.
///
/// Boxes are divided where enclosures of distances, as for measure(), do not prove in which phase they are. Each
/// statement is decided from the boxes that are proven to be in a phase, those that are proven not to meet it, and the
/// rest. Boxes are made smaller until all statements are decided or the resolution is reached.
///
/// *What is guaranteed.* A statement that is proved or refuted is true or false of the sets of points whose smallest
/// component is that of a phase, up to the rounding errors that measure() allows for. "Not empty" and "a piece" refer
/// to sets with an interior. Witnesses are points that are proven to be in their phases:
///
/// * present, proved: a point in the phase
/// * connected, refuted: two points of the phase in different pieces
/// * closed, refuted: a path from a phase inside to the space around the object; each point, and each segment between
///   two of them, is outside the walls
/// * apart, refuted: a point of each phase, closer to each other than required, or, if they touch, a point of each
/// * touching, proved: a point of each phase, joined by a path that meets no third phase; the same holds for the
///   witnesses of "apart" if the phases touch
/// * thick, refuted: a point of the phase that is not within reach of a ball
///
/// A phase that is proven to be empty refutes a statement without a witness.
///
/// Uses all threads of TBB's arena. Results do not depend on their number, unless time ends the search or it is
/// cancelled. The time is divided as follows: at most a quarter for HasVolume, then the division into boxes for the
/// other statements, then the rest, at least a quarter, for HasVolume again. Throws ModelError if the object is empty
/// or unbounded, or if an argument is out of its range.
std::vector<Proof> prove(const Phased& object, std::span<const Statement> statements, const ProveOptions& = {});

/// How thin a phase is where it is thinnest, in the sense of IsThick with the default reach.
struct WallThickness {
    Phase phase;
    double low = 0;  ///< the phase is proved to be nowhere thinner; 0 if nothing is proved
    double high = std::numeric_limits<double>::infinity();  ///< the phase is proved to be thinner than this at `place`
    std::optional<glm::vec3> place{};                       ///< a point of the phase; nullopt if `high` is infinite
};

/// Find the smallest thickness of each phase, and where it is.
///
/// Tries one thickness after another in smaller and smaller boxes, until `high` is at most 5 % more than `low`, or to
/// the limits of the options. As for IsThick, a thin fin within reach of a thick part may go unnoticed.
///
/// Returns one element for each phase but the vacuum, in ascending order. Threads, errors and progress are as for
/// prove().
std::vector<WallThickness> wall_thicknesses(const Phased& object, const ProveOptions& = {});

}  // namespace phasetree
