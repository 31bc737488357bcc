#pragma once

#include <fmt/format.h>

#include <cmath>

#include "phasetree/measuring/prove.hpp"

namespace phasetree::measuring {

/// Rejects statements with invalid phases, or with lengths out of range.
struct CheckStatement {
    void phase(Phase p) const {
        if (p.index >= Phase::capacity) throw ModelError(fmt::format("there is no phase {}", p.index));
    }
    void different(Phase a, Phase b) const {
        phase(a);
        phase(b);
        if (a == b) throw ModelError("the two phases of a statement must differ");
    }
    void length(double v, bool is_zero_allowed, const char* what) const {
        if (!(v >= 0 && std::isfinite(v) && (is_zero_allowed || v > 0)))
            throw ModelError(fmt::format("{} must be {} number, but is {}", what,
                                         is_zero_allowed ? "a finite, non-negative" : "a finite, positive", v));
    }
    void operator()(const IsPresent& s) const { phase(s.phase); }
    void operator()(const IsConnected& s) const { phase(s.phase); }
    void operator()(const IsClosed& s) const {
        if (s.walls.empty() || s.inside.empty()) throw ModelError("\"closed\" needs walls, and phases inside them");
        if (!(s.walls & s.inside).empty()) throw ModelError("a phase cannot be both a wall and inside the walls");
        if ((s.walls | s.inside).contains(vacuum))
            throw ModelError("the vacuum surrounds the object, so it is neither a wall nor inside walls");
    }
    void operator()(const AreApart& s) const {
        different(s.first, s.second);
        length(s.at_least, true, "the distance");
    }
    void operator()(const AreTouching& s) const { different(s.first, s.second); }
    void operator()(const IsThick& s) const {
        phase(s.phase);
        if (s.phase == vacuum) throw ModelError("the vacuum has no walls");
        length(s.at_least, false, "the thickness");
        length(s.reach, true, "the reach");
        if (s.reach > 0 && !(s.reach > 0.5 * s.at_least))
            throw ModelError(fmt::format("the reach must be more than half of the thickness, {}, but is {}",
                                         0.5 * s.at_least, s.reach));
    }
    void operator()(const HasVolume& s) const {
        for (const auto& [p, weight] : s.weights) {
            phase(p);
            if (p == vacuum) throw ModelError("the vacuum has no volume");
            length(weight, true, "a weight");
        }
        if (!(s.at_least <= s.at_most)) throw ModelError("the least volume must not be more than the greatest");
    }
    void operator()(const HasNoDeadNodes&) const {}
    void operator()(const HasTightBounds& s) const {
        if (!(s.at_most >= 1 && std::isfinite(s.at_most)))
            throw ModelError(fmt::format("the factor must be a number of at least 1, but is {}", s.at_most));
    }
};

}  // namespace phasetree::measuring
