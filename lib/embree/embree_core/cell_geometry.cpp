#include "embree_core/cell_geometry.hpp"

#include <utility>

#include "embree_core/cell_callbacks.hpp"

namespace phasetree::embree {

namespace {

const InterfaceCells& cells_of(void* user) {
    return *static_cast<const InterfaceCells*>(user);
}

void bounds(const RTCBoundsFunctionArguments* arguments) {
    write_bounds(*arguments->bounds_o, searched_box(cells_of(arguments->geometryUserPtr), arguments->primID));
}

void intersect_query(const RTCIntersectFunctionNArguments* arguments) noexcept {
    intersect_cell_for_query(cells_of(arguments->geometryUserPtr), arguments);
}

void occluded_query(const RTCOccludedFunctionNArguments* arguments) noexcept {
    occluded_cell_for_query(cells_of(arguments->geometryUserPtr), arguments);
}

std::optional<Phase> nothing_carried(unsigned /*lane*/) {
    return std::nullopt;
}

void intersect_packet(const RTCIntersectFunctionNArguments* arguments) noexcept {
    intersect_cell_for_packet(cells_of(arguments->geometryUserPtr), *arguments, nothing_carried,
                              [](unsigned /*lane*/, const Crossing&, float /*length*/) {});
}

void occluded_packet(const RTCOccludedFunctionNArguments* arguments) noexcept {
    occluded_cell_for_packet(cells_of(arguments->geometryUserPtr), *arguments, nothing_carried);
}

}  // namespace

CellGeometry::CellGeometry(RTCDevice device, std::shared_ptr<const InterfaceCells> cells, const Options& options)
    : handle_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER)), cells_(std::move(cells)) {
    rtcSetGeometryUserPrimitiveCount(handle_, static_cast<unsigned>(cells_->size()));
    rtcSetGeometryUserData(handle_, const_cast<InterfaceCells*>(cells_.get()));  // Embree only passes it back
    rtcSetGeometryBoundsFunction(handle_, bounds, nullptr);
    rtcSetGeometryIntersectFunction(handle_, options.rays_carry_phases ? intersect_query : intersect_packet);
    rtcSetGeometryOccludedFunction(handle_, options.rays_carry_phases ? occluded_query : occluded_packet);
}

CellGeometry::~CellGeometry() {
    if (handle_) rtcReleaseGeometry(handle_);
}

CellGeometry::CellGeometry(CellGeometry&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), cells_(std::move(other.cells_)) {}

CellGeometry& CellGeometry::operator=(CellGeometry&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(cells_, other.cells_);
    return *this;
}

}  // namespace phasetree::embree
