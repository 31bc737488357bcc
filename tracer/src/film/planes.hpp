// The list of all planes of the film.
#pragma once

#include "film/alpha_plane.hpp"
#include "film/cryptomatte_planes.hpp"
#include "film/half_plane.hpp"
#include "film/length_plane.hpp"
#include "film/light_planes.hpp"
#include "film/noise_plane.hpp"
#include "film/plane_list.hpp"
#include "film/radiance_plane.hpp"
#include "film/sampling_planes.hpp"
#include "film/surface_planes.hpp"

namespace phasetree::tracer {

/// Every plane, the picture first. The order determines only the order of channels in image files, and of bytes in film
/// files.
using Planes =
    PlaneList<RadiancePlane, AlphaPlane, DepthPlane, PositionPlane, NormalPlane, AlbedoPlane, DepthBehindPlane,
              PositionBehindPlane, NormalBehindPlane, AlbedoBehindPlane, PhaseLeftPlane, PhaseEnteredPlane, ObjectPlane,
              InstancePlane, LengthPlane, DirectPlane, IndirectPlane, LightGroupsPlane, VariancePlane, NoisePlane,
              SamplesPlane, HalfOfSamplesPlane, CryptoPhasePlane, CryptoObjectPlane, CryptoMaterialPlane>;

}  // namespace phasetree::tracer
