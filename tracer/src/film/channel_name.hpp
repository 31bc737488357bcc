// Names of a scene's objects as parts of channel names, in which a point separates layer and channel.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace phasetree::tracer {

/// Returns `prefix` + name + `suffix` for each name. All characters except ASCII letters, digits, - and _ become _.
/// Names that would be equal get a number appended.
inline std::vector<std::string> channel_names(const std::string& prefix, const std::vector<std::string>& names,
                                              const std::string& suffix) {
    const auto is_plain = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    };
    std::vector<std::string> channels;
    for (std::string name : names) {
        std::ranges::replace_if(
            name, [&](char c) { return !is_plain(c); }, '_');
        std::string channel = prefix + name + suffix;
        for (int i = 2; std::ranges::find(channels, channel) != channels.end(); ++i)
            channel = prefix + name + "_" + std::to_string(i) + suffix;
        channels.push_back(std::move(channel));
    }
    return channels;
}

}  // namespace phasetree::tracer
