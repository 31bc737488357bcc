// The list of all planes of the film.
#pragma once

#include "film/plane_list.hpp"
#include "film/radiance_plane.hpp"

namespace phasetree::tracer {

/// Every plane, the picture first.
using Planes = PlaneList<RadiancePlane>;

}  // namespace phasetree::tracer
