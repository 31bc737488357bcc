#include "command/not_shown_report.hpp"

#include <algorithm>
#include <cstddef>

#include "command/streams.hpp"

namespace phasetree::tracer {

void warn_of_what_is_not_shown(const Scene& scene) {
    constexpr std::size_t most_reported = 20;
    const std::size_t reported = std::min(scene.not_shown.size(), most_reported);
    for (std::size_t i = 0; i < reported; ++i) say("warning: {}\n", scene.not_shown[i]);
    if (reported < scene.not_shown.size())
        say("warning: {} more things are not shown\n", scene.not_shown.size() - reported);
}

}  // namespace phasetree::tracer
