// Solving: finding the number for which a phase of an object has a given volume.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "phasetree/measuring/measure.hpp"

namespace phasetree {

/// Returns the object for a number, such as the level of a liquid.
using ObjectOf = std::function<Phased(double)>;

/// The quantity, and the value that it is to have. The quantity is the sum of the volumes of these phases, each times
/// its weight. A weight is a density, or 1 for a volume. Weights are not negative, and at least one is positive.
struct SolveTarget {
    std::vector<std::pair<Phase, double>> weights;
    double value = 0;
};

/// A number, and the quantity of the object for that number.
struct SolvePoint {
    double at = 0;
    Measured measure;
};

/// What is known while solving.
struct SolveProgress {
    std::optional<SolvePoint> low, high;  ///< the ends of the bracket that are known so far
    double share = 0;                     ///< a guess of the fraction of the work that is done
};

struct SolveOptions {
    /// Solving ends once the bracket is at most this wide; 0 for a thousandth of the first bracket. Not negative.
    double width = 0;
    /// Solving ends after this time, whatever is known by then. Positive.
    double seconds = std::numeric_limits<double>::infinity();
    /// The maximum number of boxes of one measurement. Unlike the time, this limit gives equal results on all machines.
    std::size_t max_boxes = std::size_t{1} << 24;
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to stop and get what is known so far
    std::function<void(const SolveProgress&)> progress{};  ///< called from one thread at a time
};

/// Why solving ended.
enum class SolveEnd {
    width,      ///< the bracket is as narrow as requested
    undecided,  ///< no further number could be placed on one side of the target: each measured interval contains it
    same_side,  ///< there is no bracket, because both of its ends are certainly on the same side of the target
    seconds,    ///< the time ran out
    cancelled   ///< SolveOptions::cancelled returned true
};

/// In the order of SolveEnd: "tolerance", "undecided", "same side", "time" or "interrupted".
std::string_view name_of(SolveEnd);

struct SolveResult {
    SolveEnd end = SolveEnd::width;
    /// The ends of the bracket. For each, the guaranteed interval of the quantity does not contain the target. If there
    /// is no bracket, the ends that were measured.
    std::optional<SolvePoint> low, high;
    /// A number in the bracket with few digits, for which the quantity is close to the target; if there was no time to
    /// measure it, the closer end of the bracket.
    std::optional<SolvePoint> best;
    /// For SolveEnd::undecided: the first number that was tried, and the interval of its quantity, which contains the
    /// target.
    std::optional<SolvePoint> undecided;
    std::size_t measurements = 0;

    /// Whether the target certainly lies between the quantities at both ends.
    bool has_bracket() const { return low && high && end != SolveEnd::same_side; }
};

/// Find a number for which the quantity has its target value, by bisection of a bracket.
///
/// object     called from the calling thread. Its exceptions are passed on.
/// low, high  the first bracket; low < high, both finite.
///
/// A number becomes an end of the bracket only if the guaranteed interval of its quantity lies entirely on one side of
/// the target. So the quantity is certainly below the target at one end and above it at the other. If it is a
/// continuous function of the number, it has the value somewhere in between, once or several times; one such number is
/// found. If it jumps across the target, the bracket closes in on a jump. Intervals are narrowed only as far as the
/// decision needs. If the middle of the bracket is too close to the target for that, nearby numbers are tried.
///
/// The result does not depend on the number of threads, unless solving ends by time or is cancelled. Throws ModelError
/// for arguments out of range, and for objects that measure() rejects, except empty ones, whose volumes are 0.
SolveResult solve(const ObjectOf& object, const SolveTarget& target, double low, double high,
                  const SolveOptions& options = {});

}  // namespace phasetree
