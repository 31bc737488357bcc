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
    return spread_of(seconds_[contestant]);
}

Spread Turns::ratio(std::size_t a, std::size_t b) const {
    std::vector<double> ratios;
    for (std::size_t round = 0; round < seconds_[a].size(); ++round)
        ratios.push_back(seconds_[a][round] / seconds_[b][round]);
    return spread_of(std::move(ratios));
}

Turns in_turn(const std::vector<Contestant>& contestants, const Timing& timing) {
    const std::size_t n = contestants.size();
    Turns turns;
    turns.seconds_.resize(n);
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
            const double start = seconds(timing.clock);
            for (int r = 0; r < repeats[i]; ++r) same = c.work() == turns.checksums_[i] && same;
            turns.seconds_[i].push_back((seconds(timing.clock) - start) / repeats[i]);
            if (!same) throw std::logic_error("\"" + c.name + "\" gave two different results");
        }
    }
    return turns;
}

}  // namespace phasetree::bench
