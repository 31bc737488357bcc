#pragma once

#include "api/errors.hpp"
#include "api/handles.hpp"
#include "object/motion.hpp"
#include "object/object.hpp"

namespace phasetree::embree::api {

/// What is behind a PhasetreeGeometry.
struct GeometryData {
    GeometryData(RTCDevice device, unsigned flags);
    ~GeometryData();
    GeometryData(const GeometryData&) = delete;
    GeometryData& operator=(const GeometryData&) = delete;

    RTCDevice device;
    RTCGeometry handle;
    unsigned flags;
    PhaseSet shown{PHASETREE_ALL_PHASES};
    Motion motion;
    void* user_pointer = nullptr;
    std::unique_ptr<const Object> object;

    bool has(PhasetreeGeometryFlags flag) const { return (flags & static_cast<unsigned>(flag)) != 0; }
    /// Whether a crossing is to be reported. The vacuum never counts as shown.
    bool shows(const Crossing& c) const {
        const PhaseSet materials{shown.bits & ~std::uint64_t{1}};
        return materials.contains(c.from) || materials.contains(c.to);
    }
};

using GeometryTable = HandleTable<GeometryData, 0x5047>;

inline GeometryData* find(PhasetreeGeometry handle) noexcept {
    return GeometryTable::instance().find(reinterpret_cast<std::uintptr_t>(handle));
}
/// Throws for a handle that is none.
GeometryData& data_of(PhasetreeGeometry handle);

}  // namespace phasetree::embree::api
