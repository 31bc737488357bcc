// Builds an object and its cells from the application's options.

#include "api/build.hpp"

#include <atomic>
#include <bit>
#include <cmath>

#include "embree_core/error.hpp"
#include "phasetree/cells/file.hpp"

namespace phasetree::embree::api {

namespace {

std::optional<BuildQuality> quality_of(unsigned quality) {
    switch (quality) {
        case RTC_BUILD_QUALITY_LOW:
            return BuildQuality::low;
        case RTC_BUILD_QUALITY_MEDIUM:
            return BuildQuality::medium;
        case RTC_BUILD_QUALITY_HIGH:
            return BuildQuality::medium;
        default:
            return std::nullopt;
    }
}

bool has(unsigned flags, PhasetreeGeometryFlags flag) {
    return (flags & static_cast<unsigned>(flag)) != 0;
}

void check_flags(const PhasetreeGeometryOptions& options) {
    const auto known = static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT) |
                       static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_NO_FILTERS) |
                       static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_POINT_QUERY) |
                       static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES);
    if ((options.flags & ~known) != 0) throw invalid("options->flags has unknown bits: {:#x}", options.flags & ~known);
    if (!has(options.flags, PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES)) return;
    if (!has(options.flags, PHASETREE_GEOMETRY_FLAG_NO_FILTERS))
        throw invalid(
            "options->flags has CELL_PRIMITIVES without NO_FILTERS; a filter function would see some crossings twice");
    if (has(options.flags, PHASETREE_GEOMETRY_FLAG_POINT_QUERY))
        throw invalid(
            "options->flags has CELL_PRIMITIVES and POINT_QUERY; a point query would query the object once per cell "
            "(use phasetreeFindClosestInterface)");
    require_all_shown(options.shownPhases);
}

CellOptions cell_options(const PhasetreeGeometryOptions& options) {
    CellOptions cells;
    cells.resolution = options.resolution;
    cells.quality = *quality_of(options.buildQuality);
    cells.opaque = {options.opaquePhases};
    if (options.cellDivisions > 0) cells.max_depth = static_cast<int>(options.cellDivisions);
    cells.max_bytes = options.maxBytes;
    // Set by either of the application's two ways to end a build.
    const auto is_ended = std::make_shared<std::atomic<bool>>(false);
    if (options.cancelled || options.progress)
        cells.cancelled = [&options, is_ended] {
            return *is_ended || (options.cancelled && options.cancelled(options.cancelledUserPtr));
        };
    if (options.progress)
        cells.progress = [&options, is_ended](float done) {
            if (!*is_ended && !options.progress(options.progressUserPtr, static_cast<double>(done))) *is_ended = true;
        };
    return cells;
}

std::unique_ptr<const Object> object_of(RTCDevice device, std::shared_ptr<const InterfaceCells> cells, unsigned flags) {
    const auto when = has(flags, PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES) ? Object::SceneWithin::when_asked
                                                                          : Object::SceneWithin::at_once;
    return std::make_unique<const Object>(device, std::move(cells), when);
}

}  // namespace

void require_shown(PhasetreePhaseSet opaque, PhasetreePhaseSet shown) {
    if (const PhasetreePhaseSet hidden = opaque & ~shown; hidden != 0)
        throw invalid("phase {} is opaque and hidden; no ray can be in it", std::countr_zero(hidden));
}

void require_all_shown(PhasetreePhaseSet shown) {
    if (!shows_all({shown}))
        throw invalid(
            "a geometry with PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES shows all phases, so phase {} cannot be hidden",
            std::countr_zero(~(shown | 1)));
}

PhasetreeGeometryOptions checked(const PhasetreeGeometryOptions* given) {
    PhasetreeGeometryOptions options;
    phasetreeInitGeometryOptions(&options);
    if (given) options = *given;
    if (!(options.resolution >= 0) || !std::isfinite(options.resolution))
        throw invalid("options->resolution is {}; it must be a distance, or 0 for the library's choice",
                      options.resolution);
    if (options.cellDivisions > 20)
        throw invalid("options->cellDivisions is {}; it must be at most 20", options.cellDivisions);
    if (!quality_of(options.buildQuality))
        throw invalid("options->buildQuality is {}; it must be RTC_BUILD_QUALITY_LOW, MEDIUM or HIGH",
                      options.buildQuality);
    if (PhaseSet{options.opaquePhases}.contains(vacuum))
        throw invalid("options->opaquePhases contains the vacuum, phase 0, which cannot be opaque");
    require_shown(options.opaquePhases, options.shownPhases);
    check_flags(options);
    return options;
}

std::unique_ptr<const Object> build_object(RTCDevice device, const Phased& tree,
                                           const PhasetreeGeometryOptions& options, unsigned flags) {
    const CellOptions with = cell_options(options);
    const auto cells = std::make_shared<const InterfaceCells>(tree, with);
    // The final progress report, of 1, may cancel the call, which nothing checks after that.
    if (with.cancelled && with.cancelled()) throw BuildCancelled();
    return object_of(device, cells, flags);
}

std::unique_ptr<const Object> read_object(RTCDevice device, const Phased& tree, const PhasetreeGeometryOptions& options,
                                          const char* path) {
    return object_of(device, read_cells(path, tree, cell_options(options)), options.flags);
}

}  // namespace phasetree::embree::api
