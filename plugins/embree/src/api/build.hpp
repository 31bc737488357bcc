#pragma once

#include "api/geometry_data.hpp"

namespace phasetree::embree::api {

/// Returns the application's options, or the defaults if there are none. Throws ApiError for invalid options.
PhasetreeGeometryOptions checked(const PhasetreeGeometryOptions*);

/// Throws ApiError if a phase is opaque but not shown, because rays pass through what is not shown.
void require_shown(PhasetreePhaseSet opaque, PhasetreePhaseSet shown);
/// Throws ApiError unless all phases are shown; for geometries whose primitives are the cells.
void require_all_shown(PhasetreePhaseSet shown);

/// Creates the object of a geometry with these flags, from cells that are built or read from a file. Both throw what
/// InterfaceCells and read_cells throw, and ApiError if Embree fails.
std::unique_ptr<const Object> build_object(RTCDevice, const Phased& tree, const PhasetreeGeometryOptions&,
                                           unsigned flags);
std::unique_ptr<const Object> read_object(RTCDevice, const Phased& tree, const PhasetreeGeometryOptions&,
                                          const char* path);

}  // namespace phasetree::embree::api
