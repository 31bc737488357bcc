#include "scene/shutter.hpp"

#include <algorithm>

#include "phasetree/io/keys.hpp"

namespace phasetree::tracer {

namespace {

// The number of equal steps. From one to the next, a rotation takes the shorter way, so a rotation that is keyed by its
// angle may make up to 8 turns while the shutter is open.
constexpr int steps = 16;

// Each moment reads all keys of the value.
constexpr std::size_t most_read = 50'000'000;

}  // namespace

std::vector<double> moments_of(const Document& document, Value value, const Shutter& shutter) {
    const std::vector<double> keys = times_of_keys(value);
    if (keys.empty() || shutter.is_instant()) return {};
    std::vector<double> moments;
    for (int i = 0; i <= steps; ++i) moments.push_back(static_cast<double>(i) / steps);
    for (const double seconds : keys) {
        const double moment = (seconds - document.seconds() - shutter.open) / (shutter.close - shutter.open);
        if (moment > 0 && moment < 1) moments.push_back(moment);
    }
    std::ranges::sort(moments);
    moments.erase(std::unique(moments.begin(), moments.end()), moments.end());
    if (moments.size() * keys.size() > most_read)
        throw document.error(value,
                             "there are too many keys while the shutter is open; remove some, or shorten \"shutter\"");
    return moments;
}

Document at_moment(const Document& document, const Shutter& shutter, double moment) {
    return document.at(document.seconds() + shutter.open + moment * (shutter.close - shutter.open));
}

}  // namespace phasetree::tracer
