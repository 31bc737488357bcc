#pragma once

#include "camera/camera.hpp"
#include "phasetree/math/bounds.hpp"
#include "rays/ray.hpp"

namespace phasetree::bench {

// One ray through the centre of each pixel of a camera in the vacuum, whose lens is a pinhole, row by row.
Rays camera_rays(tracer::AnyCameraParameters, int width, int height);

// A camera that sees a whole box, from in front (−y) and a little above.
tracer::ThinLensParameters camera_for(const Bounds&);

}  // namespace phasetree::bench
