#include "command/overlap_report.hpp"

#include <fmt/format.h>

#include "command/load.hpp"
#include "command/streams.hpp"
#include "scene/overlaps.hpp"

namespace phasetree::tracer {

namespace {

std::string named(const PlacedObjects& placed, const OverlappingCopy& copy) {
    const std::string& name = placed.objects[copy.object].name;
    return placed.copies() == placed.objects.size() ? fmt::format("\"{}\"", name)
                                                    : fmt::format("\"{}\" (copy {})", name, copy.number);
}

}  // namespace

void warn_of_overlaps(const Document& document, const PlacedObjects& placed) {
    if (placed.empty()) return;
    const Overlaps overlaps = find_overlaps(placed);
    const auto warn = [&](const std::string& what) {
        say("{}\n", document.error(model_in(document), "warning: " + what).what());
    };
    for (const Overlap& o : overlaps.found)
        warn(fmt::format("{} and {} overlap, for example at [{}, {}, {}]; {} takes precedence", named(placed, o.first),
                         named(placed, o.second), o.at.x, o.at.y, o.at.z, named(placed, o.first)));
    if (overlaps.has_more) warn("more copies of these objects may overlap; they were not checked");
    if (overlaps.is_cut_short) warn("too many objects are close to each other to check them all; others may overlap");
}

}  // namespace phasetree::tracer
