#pragma once

#include "api/geometry_data.hpp"

namespace phasetree::embree::api {

/// The application's options, or the defaults where it gives none. Throws ApiError for what cannot be.
PhasetreeGeometryOptions checked(const PhasetreeGeometryOptions*);

/// Throws ApiError where a phase is opaque and not shown: rays pass through what is not shown.
void require_shown(PhasetreePhaseSet opaque, PhasetreePhaseSet shown);
/// Throws ApiError unless everything is shown, for a geometry whose primitives are the cells.
void require_all_shown(PhasetreePhaseSet shown);

/// An object for a geometry with these flags: with cells that are built, or read from a file. Both throw what
/// InterfaceCells and read_cells do, and ApiError for what Embree refuses.
std::unique_ptr<const Object> build_object(RTCDevice, const Phased& tree, const PhasetreeGeometryOptions&,
                                           unsigned flags);
std::unique_ptr<const Object> read_object(RTCDevice, const Phased& tree, const PhasetreeGeometryOptions&,
                                          const char* path);

}  // namespace phasetree::embree::api
