// Measuring: volumes, masses, centres of mass, tensors of inertia and bounding boxes of an object's phases.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A number that is guaranteed to lie in [low, high], and an estimate of it, which also lies there. The estimate is
/// usually far closer to the number than the interval is wide, but nothing is guaranteed about that.
struct Measured {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
    double estimate = 0;

    double width() const { return high - low; }
    bool contains(double v) const { return low <= v && v <= high; }
};

/// The integrals over a body of constant density, or over several such bodies.
struct Body {
    Measured volume;  ///< in cubed units of length
    Measured mass;    ///< its density times its volume; the volume for a density of 1
    /// The centre of mass. If the volume may be 0, the intervals are infinite.
    std::array<Measured, 3> centre{};
    /// The tensor of inertia about the centre of mass, in units of mass times squared length: the integrals of
    /// ρ (|r|² δᵢⱼ − rᵢ rⱼ). Symmetric.
    std::array<std::array<Measured, 3>, 3> inertia{};
};

/// What is known of one phase.
struct MeasuredPhase {
    Phase phase;
    /// The density from MeasureOptions::densities; otherwise 1, so that the mass is the volume.
    double density = 1;
    bool has_density = false;
    Body body;
    /// The phase's bounding box: its lowest and highest coordinates. If the phase may be empty, the intervals are
    /// infinite.
    std::array<Measured, 3> box_low{}, box_high{};
};

struct MeasureResult;

struct MeasureOptions {
    /// Measuring ends once the interval of each phase's volume is no wider than this fraction of the volume. For phases
    /// that make up less than a thousandth of the object, it is a fraction of that thousandth instead. Positive.
    double tolerance = 1e-3;
    /// The phases whose volumes must be that precise; all phases by default. Those of the others are measured along the
    /// way.
    std::optional<PhaseSet> precise_phases{};
    /// Measuring ends after this time, whatever is known by then. Positive.
    double seconds = std::numeric_limits<double>::infinity();
    /// Measuring ends once it would take more than about this many boxes to divide the object. Unlike the time, this
    /// limit gives equal results on all machines.
    std::size_t max_boxes = std::size_t{1} << 26;
    /// Densities of phases, in units of mass per cubed unit of length. Not negative.
    std::vector<std::pair<Phase, double>> densities{};
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to stop and get what is known so far
    /// Receives what is known after each pass over the object, from the calling thread. Measuring ends once it returns
    /// true, such as when the intervals answer a question.
    std::function<bool(const MeasureResult&)> is_enough{};
    /// Receives the fraction of the work that is done, in (0, 1], strictly increasing up to 1. Called from one thread
    /// at a time. A guess, because how fast intervals shrink is not known beforehand.
    std::function<void(float)> progress{};
};

/// Why measuring ended.
enum class MeasureEnd {
    tolerance,  ///< all volumes are as precise as requested
    precision,  ///< smaller boxes would not help, because of the rounding errors of 32-bit coordinates
    seconds,    ///< the time ran out
    boxes,      ///< MeasureOptions::max_boxes
    cancelled,  ///< MeasureOptions::cancelled returned true
    enough      ///< MeasureOptions::is_enough returned true
};
/// "tolerance", "precision", "time", "boxes", "interrupted" or "enough".
std::string_view name_of(MeasureEnd);

struct MeasureResult {
    Bounds bounds;                      ///< a box around the object, with a margin of vacuum
    std::vector<MeasuredPhase> phases;  ///< in ascending order, without the vacuum
    Measured vacuum;                    ///< the volume of the vacuum in the bounds
    /// The phases with densities as one body; nullopt if no densities are given.
    std::optional<Body> all;
    MeasureEnd end = MeasureEnd::tolerance;
    /// The number of boxes that were examined for this result. Boxes of coarser passes, whose results a finer pass has
    /// replaced, do not count.
    std::size_t boxes = 0;
};

/// Measure the phases of an object.
///
/// The method is adaptive subdivision with guaranteed bounds. The bounds of the object are divided into boxes. In each,
/// the program is pruned, and its values are enclosed, as for interface cells. If the enclosures prove that a box is in
/// one phase, all of its volume counts for that phase. In any other box, a phase's component is enclosed between two
/// linear functions with the same gradient where possible. Their zeros are parallel planes: the phase is proven to
/// contain the part of the box below one of them and nothing above the other. Where that is not possible, its share of
/// the box is between 0 and 1. Boxes that leave too much in doubt are divided.
///
/// *What is guaranteed.* An interval contains the measure of the set of points whose smallest component is that of the
/// phase. This holds whether components are computed in real numbers or, as for labels, in 32 bits. The difference
/// between the two, the rounding error of any component, is taken to be at most half a resolution (see
/// InterfaceTracer). That allowance is the one assumption, and is the same for tracing (lib/README.md, "Allowances for
/// rounding errors"). It limits how narrow intervals can get: to about two resolutions times a phase's area. Sums of
/// boxes are computed in double, and the interval includes a bound on their rounding errors: each term takes part in at
/// most m additions, so a sum errs by at most m·2⁻⁵³ times the sum of the terms' magnitudes.
///
/// Uses all threads of TBB's arena. The result does not depend on their number, unless measuring ends by time or is
/// cancelled; intervals are still guaranteed then. Memory does not grow with the number of boxes. Thread-safe.
///
/// Throws ModelError if the object is empty or unbounded, or too far from the origin for its size; if the tolerance or
/// the time is not a positive number; or if a density is negative or infinite, or is given for a phase that the object
/// does not have.
MeasureResult measure(const Phased& object, const MeasureOptions& options = {});

}  // namespace phasetree
