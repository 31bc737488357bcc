#pragma once

#include "camera/thin_lens.hpp"
#include "phasetree/math/bounds.hpp"
#include "rays/ray.hpp"

namespace phasetree::bench {

// One ray through the centre of each pixel of a pinhole camera in the vacuum, row by row.
Rays camera_rays(tracer::ThinLensParameters camera, int width, int height);

// A camera that sees a whole box, from in front (−y) and a little above.
tracer::ThinLensParameters camera_for(const Bounds&);

}  // namespace phasetree::bench
