// Geometry handles: creation, reference counting, lookup and release.

#include "api/build.hpp"
#include "api/tree_data.hpp"
#include "phasetree/cells/file.hpp"

namespace phasetree::embree::api {

namespace {

std::uint64_t number_of(PhasetreeGeometry handle) {
    return reinterpret_cast<std::uintptr_t>(handle);
}

ApiError no_geometry(PhasetreeGeometry handle) {
    return {PHASETREE_ERROR_INVALID_HANDLE,
            handle ? "geometry is not a valid handle, or has already been released" : "geometry is NULL"};
}

// Creates a geometry's handle; object() creates its object.
template <class MakeObject>
void make_geometry(RTCDevice device, const PhasetreeGeometryOptions& options, PhasetreeGeometry* geometry,
                   MakeObject&& object) {
    auto data = std::make_unique<GeometryData>(device, options.flags);
    data->shown = {options.shownPhases};
    data->set_object(object());
    const RTCGeometry handle = data->handle;
    const auto number = GeometryTable::instance().insert(std::move(data));
    *geometry = reinterpret_cast<PhasetreeGeometry>(static_cast<std::uintptr_t>(number));
    rtcSetGeometryUserData(handle, *geometry);
}

}  // namespace

GeometryData& data_of(PhasetreeGeometry handle) {
    GeometryData* data = find(handle);
    if (!data) throw no_geometry(handle);
    return *data;
}

GeometryData::GeometryData(RTCDevice owner, unsigned its_flags)
    : device(owner), handle(rtcNewGeometry(owner, RTC_GEOMETRY_TYPE_USER)), flags(its_flags) {
    if (!handle) throw ApiError(PHASETREE_ERROR_EMBREE, "Embree cannot create a geometry");
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

void GeometryData::set_object(std::unique_ptr<const Object> its_object) {
    object = std::move(its_object);
    if (has_cell_primitives()) rtcSetGeometryUserPrimitiveCount(handle, static_cast<unsigned>(object->cells().size()));
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
        make_geometry(device, o, geometry, [&] { return build_object(device, model.tree.object, o, o.flags); });
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
        make_geometry(device, o, geometry, [&] { return read_object(device, model.tree.object, o, path); });
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
                           "embreeGeometry was not created by this library, its handle has been released, or its user "
                           "pointer was replaced");
        *geometry = handle;
    });
}
