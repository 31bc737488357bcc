// What a scene file says of a camera: the other direction of read_camera.
#pragma once

#include <string>

#include "camera/camera.hpp"
#include "film/pixel_filter.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// The JSON text that stands behind "camera":, by the kinds' lists of parameters. What may be left out and is as it is
/// when it is left out, is left out.
std::string camera_text(const AnyCameraParameters& camera, const PixelFilter& filter);

/// A scene's text with this camera instead of its own, and all else as it was. SceneError if it has none.
std::string with_camera(const Document& document, const std::string& camera);

}  // namespace phasetree::tracer
