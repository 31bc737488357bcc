#include "measure/in_turn.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace phasetree::bench {

Spread spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
    return {median, values.front(), values.back()};
}

Spread Turns::seconds(std::size_t contestant) const {
    return spread_of(by(clock_)[contestant]);
}

Spread Turns::ratio(std::size_t a, std::size_t b, Clock clock) const {
    const Rounds& rounds = by(clock);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < rounds[a].size(); ++i) ratios.push_back(rounds[a][i] / rounds[b][i]);
    return spread_of(std::move(ratios));
}

Turns in_turn(const std::vector<Contestant>& contestants, const Timing& timing) {
    const std::size_t n = contestants.size();
    Turns turns;
    turns.clock_ = timing.clock;
    for (auto& rounds : turns.seconds_) rounds.resize(n);
    std::vector<int> repeats;
    for (const Contestant& c : contestants) {
        if (c.prepare) c.prepare();
        const double start = seconds(timing.clock);
        turns.checksums_.push_back(c.work());
        const double once = std::max(seconds(timing.clock) - start, 1e-7);
        repeats.push_back(static_cast<int>(std::clamp(std::ceil(timing.least_seconds / once), 1.0, 1e6)));
    }
    for (int round = 0; round < timing.rounds; ++round) {
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = round % 2 == 0 ? k : n - 1 - k;
            const Contestant& c = contestants[i];
            if (c.prepare) c.prepare();
            bool same = true;
            std::array<double, clocks.size()> start{};
            for (const Clock clock : clocks) start[static_cast<std::size_t>(clock)] = seconds(clock);
            for (int r = 0; r < repeats[i]; ++r) same = c.work() == turns.checksums_[i] && same;
            for (const Clock clock : clocks) {
                const auto which = static_cast<std::size_t>(clock);
                turns.seconds_[which][i].push_back((seconds(clock) - start[which]) / repeats[i]);
            }
            if (!same) throw std::logic_error("\"" + c.name + "\" gave two different results");
        }
    }
    return turns;
}

}  // namespace phasetree::bench
