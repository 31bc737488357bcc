// What a scene file says of a camera: the other direction of read_camera.
#pragma once

#include <string>

#include "camera/camera.hpp"
#include "film/pixel_filter.hpp"

namespace phasetree::tracer {

/// The JSON text that stands behind "camera":, by the kinds' lists of parameters. What may be left out and is as it is
/// when it is left out, is left out.
std::string camera_text(const AnyCameraParameters& camera, const PixelFilter& filter);

}  // namespace phasetree::tracer
