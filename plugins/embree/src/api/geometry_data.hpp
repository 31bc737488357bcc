#pragma once

#include <array>

#include "api/errors.hpp"
#include "api/handles.hpp"
#include "object/motion.hpp"
#include "object/object.hpp"

namespace phasetree::embree::api {

/// Whether a set has every phase but perhaps the vacuum, which never counts as shown.
inline bool shows_all(PhaseSet shown) {
    return (shown.bits | 1) == PHASETREE_ALL_PHASES;
}

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
    struct PhaseUserData {
        std::int64_t integer = 0;
        void* pointer = nullptr;
    };
    std::array<PhaseUserData, PHASETREE_MAX_PHASES> of_phase{};  ///< the application's
    std::unique_ptr<const Object> object;

    bool has(PhasetreeGeometryFlags flag) const { return (flags & static_cast<unsigned>(flag)) != 0; }
    bool has_cell_primitives() const { return has(PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES); }
    /// Gives the geometry an object, and the RTCGeometry its number of primitives.
    void set_object(std::unique_ptr<const Object>);
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
/// What is not possible now, though it is at other times.
inline ApiError not_now(const std::string& why) {
    return {PHASETREE_ERROR_INVALID_OPERATION, why};
}
/// Where the object is at a time. Throws ApiError if the motion has no inverse there.
Placement placement_at(const GeometryData&, float time);

/// Throws for a handle that is none.
GeometryData& data_of(PhasetreeGeometry handle);

/// Three floats of the application's.
inline void write_point(float* out, const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) out[i] = v[i];
}
/// Throws ApiError unless they are a point.
inline glm::vec3 read_point(const float* p) {
    require(p, "point");
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(p[i])) throw invalid("point has an entry that is no finite number");
    return {p[0], p[1], p[2]};
}

}  // namespace phasetree::embree::api
