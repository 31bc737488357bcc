// Timing on a machine that others use too: a claim is a ratio of two things timed in turn, A B B A A B …, so that both
// meet the same clock rate and the same neighbours; the ratio is the median over rounds.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "measure/checksum.hpp"
#include "measure/clock.hpp"

namespace phasetree::bench {

struct Timing {
    int rounds = 7;
    double least_seconds = 0.15;  // of one turn; short work is repeated within it
    Clock clock = Clock::thread;
};

struct Contestant {
    std::string name;
    std::function<Checksum()> work;
    std::function<void()> prepare{};  // before each turn, not timed
};

// A median with the least and the largest of what it is the median of.
struct Spread {
    double median = 0, low = 0, high = 0;
};
Spread spread_of(std::vector<double> values);

class Turns {
  public:
    // The work of one call.
    Spread seconds(std::size_t contestant) const;
    // Paired: time of `a` over time of `b` in the same round, by the timing's clock or by another.
    Spread ratio(std::size_t a, std::size_t b) const { return ratio(a, b, clock_); }
    Spread ratio(std::size_t a, std::size_t b, Clock clock) const;
    const Checksum& checksum(std::size_t contestant) const { return checksums_[contestant]; }

  private:
    friend Turns in_turn(const std::vector<Contestant>&, const Timing&);
    using Rounds = std::vector<std::vector<double>>;  // [contestant][round]
    const Rounds& by(Clock clock) const { return seconds_[static_cast<std::size_t>(clock)]; }

    Clock clock_ = Clock::thread;
    std::array<Rounds, clocks.size()> seconds_;
    std::vector<Checksum> checksums_;
};

// Warms each up once, then times them in turn; every second round in the opposite order. Throws std::logic_error if a
// contestant gives two different results.
Turns in_turn(const std::vector<Contestant>&, const Timing&);

}  // namespace phasetree::bench
