// The list of all planes of the film.
#pragma once

#include "film/plane_list.hpp"
#include "film/radiance_plane.hpp"

namespace phasetree::tracer {

/// Every plane, the picture first. Of its order depend only the order of channels in files, and of bytes in those that
/// films are kept in.
using Planes = PlaneList<RadiancePlane>;

}  // namespace phasetree::tracer
