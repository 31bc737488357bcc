#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include "api/geometry_data.hpp"
#include "api/tree_data.hpp"
#include "phasetree/cells/file.hpp"

namespace phasetree::embree::api {

namespace {

std::uint64_t number_of(PhasetreeGeometry handle) {
    return reinterpret_cast<std::uintptr_t>(handle);
}

ApiError no_geometry(PhasetreeGeometry handle) {
    return {PHASETREE_ERROR_INVALID_HANDLE,
            handle ? "geometry is no geometry's handle, or that of one already released" : "geometry is NULL"};
}

/// Rays pass through what is not shown.
void require_shown(PhasetreePhaseSet opaque, PhasetreePhaseSet shown) {
    if (const PhasetreePhaseSet hidden = opaque & ~shown; hidden != 0)
        throw invalid("phase {} is opaque and not shown; no ray may be in it", std::countr_zero(hidden));
}

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

PhasetreeGeometryOptions checked(const PhasetreeGeometryOptions* given) {
    PhasetreeGeometryOptions options;
    phasetreeInitGeometryOptions(&options);
    if (given) options = *given;
    if (!(options.resolution >= 0) || !std::isfinite(options.resolution))
        throw invalid("options->resolution is {}; it must be a distance, or 0 for the library's choice",
                      options.resolution);
    if (options.cellDivisions > 20)
        throw invalid("options->cellDivisions is {}; at most 20 are possible", options.cellDivisions);
    if (!quality_of(options.buildQuality))
        throw invalid("options->buildQuality is {}; it must be RTC_BUILD_QUALITY_LOW, MEDIUM or HIGH",
                      options.buildQuality);
    if (PhaseSet{options.opaquePhases}.contains(vacuum))
        throw invalid("options->opaquePhases has the vacuum, phase 0, which cannot be opaque");
    require_shown(options.opaquePhases, options.shownPhases);
    const auto known = static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT) |
                       static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_NO_FILTERS) |
                       static_cast<unsigned>(PHASETREE_GEOMETRY_FLAG_POINT_QUERY);
    if ((options.flags & ~known) != 0) throw invalid("options->flags has unknown bits: {:#x}", options.flags & ~known);
    return options;
}

CellOptions cell_options(const PhasetreeGeometryOptions& options) {
    CellOptions cells;
    cells.resolution = options.resolution;
    cells.quality = *quality_of(options.buildQuality);
    cells.opaque = {options.opaquePhases};
    if (options.cellDivisions > 0) cells.deepest = static_cast<int>(options.cellDivisions);
    cells.most_bytes = options.mostBytes;
    // The application's two ways to end a build.
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

std::unique_ptr<const Object> object_of(RTCDevice device, std::shared_ptr<const InterfaceCells> cells) {
    try {
        return std::make_unique<const Object>(device, std::move(cells));
    } catch (const EmbreeError& e) {
        const auto code = e.code() == RTC_ERROR_CANCELLED       ? PHASETREE_ERROR_CANCELLED
                          : e.code() == RTC_ERROR_OUT_OF_MEMORY ? PHASETREE_ERROR_OUT_OF_MEMORY
                                                                : PHASETREE_ERROR_EMBREE;
        throw ApiError(code, e.what());
    }
}

std::unique_ptr<const Object> build(RTCDevice device, const Phased& tree, const PhasetreeGeometryOptions& options) {
    const CellOptions with = cell_options(options);
    const auto cells = std::make_shared<const InterfaceCells>(tree, with);
    if (with.cancelled && with.cancelled()) throw BuildCancelled();  // by the last it was told
    return object_of(device, cells);
}

/// Makes a geometry's handle; `cells` gives its object.
template <class Cells>
void make_geometry(RTCDevice device, const PhasetreeGeometryOptions& options, PhasetreeGeometry* geometry,
                   Cells&& object) {
    auto data = std::make_unique<GeometryData>(device, options.flags);
    data->shown = {options.shownPhases};
    data->object = object();
    const RTCGeometry handle = data->handle;
    const auto number = GeometryTable::instance().insert(std::move(data));
    *geometry = reinterpret_cast<PhasetreeGeometry>(static_cast<std::uintptr_t>(number));
    rtcSetGeometryUserData(handle, *geometry);
}

GeometryData::PhaseUserData& of_phase(GeometryData& data, unsigned phase) {
    if (phase >= data.of_phase.size()) throw invalid("phase is {}; phases are 0 … {}", phase, data.of_phase.size() - 1);
    return data.of_phase[phase];
}

Motion motion_of(const float* transforms, unsigned count, float start, float end) {
    if (count == 0) return {};
    require(transforms, "transforms");
    if (count > RTC_MAX_TIME_STEP_COUNT)
        throw invalid("timeStepCount is {}; Embree takes at most {}", count, RTC_MAX_TIME_STEP_COUNT);
    if (count > 1 && !(std::isfinite(start) && std::isfinite(end) && start < end))
        throw invalid("startTime {} must be before endTime {}", start, end);
    std::vector<Motion::Step> steps;
    for (unsigned i = 0; i < count; ++i) {
        const float* m = transforms + 12 * i;
        if (!std::all_of(m, m + 12, [](float v) { return std::isfinite(v); }))
            throw invalid("the transform of time step {} has an entry that is no finite number", i);
        const auto placement = Placement::of(m);
        if (!placement) throw invalid("the transform of time step {} has no inverse", i);
        steps.push_back({placement->linear, placement->translation});
    }
    return {std::move(steps), start, end};
}

}  // namespace

GeometryData& data_of(PhasetreeGeometry handle) {
    GeometryData* data = find(handle);
    if (!data) throw no_geometry(handle);
    return *data;
}

GeometryData::GeometryData(RTCDevice owner, unsigned its_flags)
    : device(owner), handle(rtcNewGeometry(owner, RTC_GEOMETRY_TYPE_USER)), flags(its_flags) {
    if (!handle) throw ApiError(PHASETREE_ERROR_EMBREE, "Embree makes no geometry");
    rtcRetainDevice(device);
    rtcSetGeometryUserPrimitiveCount(handle, 1);
    rtcSetGeometryBoundsFunction(handle, phasetreeBoundsFunction, nullptr);
    rtcSetGeometryIntersectFunction(handle, phasetreeIntersectFunction);
    rtcSetGeometryOccludedFunction(handle, phasetreeOccludedFunction);
    if (has(PHASETREE_GEOMETRY_FLAG_POINT_QUERY)) rtcSetGeometryPointQueryFunction(handle, phasetreePointQueryFunction);
}

GeometryData::~GeometryData() {
    rtcReleaseGeometry(handle);
    object.reset();
    rtcReleaseDevice(device);
}

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeNewGeometry(unsigned int api_version, RTCDevice device, PhasetreeTree tree,
                                    const PhasetreeGeometryOptions* options, PhasetreeGeometry* geometry) {
    return guarded_call(__func__, [&] {
        require_version(api_version);
        require(device, "device");
        const TreeData& model = api::data_of(tree);
        require(geometry, "geometry");
        const PhasetreeGeometryOptions o = checked(options);
        make_geometry(device, o, geometry, [&] { return build(device, model.tree.object, o); });
    });
}

PhasetreeError phasetreeNewGeometryFromCells(unsigned int api_version, RTCDevice device, PhasetreeTree tree,
                                             const PhasetreeGeometryOptions* options, const char* path,
                                             PhasetreeGeometry* geometry) {
    return guarded_call(__func__, [&] {
        require_version(api_version);
        require(device, "device");
        const TreeData& model = api::data_of(tree);
        require(path, "path");
        require(geometry, "geometry");
        const PhasetreeGeometryOptions o = checked(options);
        make_geometry(device, o, geometry,
                      [&] { return object_of(device, read_cells(path, model.tree.object, cell_options(o))); });
    });
}

PhasetreeError phasetreeWriteGeometryCells(PhasetreeGeometry geometry, const char* path) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(path, "path");
        write_cells(path, data.object->cells());
    });
}

PhasetreeError phasetreeRetainGeometry(PhasetreeGeometry geometry) {
    return guarded_call(__func__, [&] {
        if (!GeometryTable::instance().retain(number_of(geometry))) throw no_geometry(geometry);
    });
}

PhasetreeError phasetreeReleaseGeometry(PhasetreeGeometry geometry) {
    return guarded_call(__func__, [&] {
        if (!GeometryTable::instance().release(number_of(geometry))) throw no_geometry(geometry);
    });
}

PhasetreeError phasetreeGetEmbreeGeometry(PhasetreeGeometry geometry, RTCGeometry* embree_geometry) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(embree_geometry, "embreeGeometry");
        *embree_geometry = data.handle;
    });
}

PhasetreeError phasetreeGetGeometryFromEmbree(RTCGeometry embree_geometry, PhasetreeGeometry* geometry) {
    return guarded_call(__func__, [&] {
        require(embree_geometry, "embreeGeometry");
        require(geometry, "geometry");
        const auto handle = static_cast<PhasetreeGeometry>(rtcGetGeometryUserData(embree_geometry));
        const GeometryData* data = find(handle);
        if (!data || data->handle != embree_geometry)
            throw ApiError(PHASETREE_ERROR_INVALID_HANDLE,
                           "embreeGeometry was not made by this library, or its handle "
                           "is released, or its user pointer was replaced");
        *geometry = handle;
    });
}

PhasetreeError phasetreeSetGeometryUserData(PhasetreeGeometry geometry, void* user_pointer) {
    return guarded_call(__func__, [&] { api::data_of(geometry).user_pointer = user_pointer; });
}

PhasetreeError phasetreeGetGeometryUserData(PhasetreeGeometry geometry, void** user_pointer) {
    return guarded_call(__func__, [&] {
        const GeometryData& data = api::data_of(geometry);
        require(user_pointer, "userPtr");
        *user_pointer = data.user_pointer;
    });
}

PhasetreeError phasetreeSetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase, int64_t user_integer,
                                                 void* user_pointer) {
    return guarded_call(__func__, [&] { of_phase(api::data_of(geometry), phase) = {user_integer, user_pointer}; });
}

PhasetreeError phasetreeGetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase, int64_t* user_integer,
                                                 void** user_pointer) {
    return guarded_call(__func__, [&] {
        const GeometryData::PhaseUserData& mine = of_phase(api::data_of(geometry), phase);
        if (user_integer) *user_integer = mine.integer;
        if (user_pointer) *user_pointer = mine.pointer;
    });
}

PhasetreeError phasetreeSetGeometryTree(PhasetreeGeometry geometry, PhasetreeTree tree,
                                        const PhasetreeGeometryOptions* options) {
    return guarded_call(__func__, [&] {
        GeometryData& data = api::data_of(geometry);
        const PhasetreeGeometryOptions o = checked(options);
        data.object = build(data.device, api::data_of(tree).tree.object, o);
        data.shown = {o.shownPhases};
    });
}

PhasetreeError phasetreeSetGeometryShownPhases(PhasetreeGeometry geometry, PhasetreePhaseSet shown) {
    return guarded_call(__func__, [&] {
        GeometryData& data = api::data_of(geometry);
        require_shown(data.object->cells().opaque().bits, shown);
        data.shown = {shown};
    });
}

PhasetreeError phasetreeSetGeometryMotion(PhasetreeGeometry geometry, const float* transforms, unsigned int count,
                                          float start, float end) {
    return guarded_call(__func__, [&] {
        GeometryData& data = api::data_of(geometry);
        data.motion = motion_of(transforms, count, start, end);
        rtcSetGeometryTimeStepCount(data.handle, data.motion.steps());
        rtcSetGeometryTimeRange(data.handle, count > 1 ? start : 0.0f, count > 1 ? end : 1.0f);
    });
}

PhasetreeError phasetreeGetGeometryStatistics(PhasetreeGeometry geometry, PhasetreeGeometryStatistics* statistics) {
    return guarded_call(__func__, [&] {
        const InterfaceCells& cells = api::data_of(geometry).object->cells();
        require(statistics, "statistics");
        const CellStatistics s = cells.statistics();
        *statistics = {s.cells,
                       s.bytes,
                       cells.whole().program().instructions.size(),
                       s.median_instructions,
                       s.most_instructions,
                       cells.resolution(),
                       static_cast<float>(s.build_seconds)};
    });
}

PhasetreeError phasetreeGetGeometryWarning(PhasetreeGeometry geometry, const char** warning) {
    return guarded_call(__func__, [&] {
        const InterfaceCells& cells = api::data_of(geometry).object->cells();
        require(warning, "warning");
        *warning = cells.warning().c_str();
    });
}
