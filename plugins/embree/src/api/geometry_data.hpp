#pragma once

#include <array>

#include "api/errors.hpp"
#include "api/handles.hpp"
#include "object/motion.hpp"
#include "object/object.hpp"

namespace phasetree::embree::api {

/// Whether a set contains every phase. The vacuum, which never counts as shown, may be missing.
inline bool shows_all(PhaseSet shown) {
    return (shown.bits | 1) == PHASETREE_ALL_PHASES;
}

/// The data behind a PhasetreeGeometry.
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
    struct PhaseUserData {
        std::int64_t integer = 0;
        void* pointer = nullptr;
    };
    std::array<PhaseUserData, PHASETREE_MAX_PHASES> of_phase{};  ///< belongs to the application
    std::unique_ptr<const Object> object;

    bool has(PhasetreeGeometryFlags flag) const { return (flags & static_cast<unsigned>(flag)) != 0; }
    bool has_cell_primitives() const { return has(PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES); }
    /// Sets the geometry's object, and the RTCGeometry's number of primitives.
    void set_object(std::unique_ptr<const Object>);
    /// Whether to report a crossing. The vacuum never counts as shown.
    bool shows(const Crossing& c) const {
        const PhaseSet materials{shown.bits & ~std::uint64_t{1}};
        return materials.contains(c.from) || materials.contains(c.to);
    }
};

using GeometryTable = HandleTable<GeometryData, 0x5047>;

inline GeometryData* find(PhasetreeGeometry handle) noexcept {
    return GeometryTable::instance().find(reinterpret_cast<std::uintptr_t>(handle));
}
/// An error for an operation that is not possible in the current state.
inline ApiError not_now(const std::string& why) {
    return {PHASETREE_ERROR_INVALID_OPERATION, why};
}
/// The placement of the object at a time. Throws ApiError if the motion is not invertible there.
Placement placement_at(const GeometryData&, float time);

/// Throws if the handle is invalid.
GeometryData& data_of(PhasetreeGeometry handle);

/// Writes three floats for the application.
inline void write_point(float* out, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = v[i];
}
/// Throws ApiError unless they are a valid point.
inline glm::vec3 read_point(const float* p) {
    require(p, "point");
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(p[i])) throw invalid("point has an entry that is not finite");
    return {p[0], p[1], p[2]};
}

}  // namespace phasetree::embree::api
