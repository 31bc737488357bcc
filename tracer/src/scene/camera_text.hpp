// Writes cameras as scene files contain them; the inverse of read_camera.
#pragma once

#include <string>

#include "camera/camera.hpp"
#include "film/pixel_filter.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// The JSON text that follows "camera":, according to the kinds' lists of parameters. Optional parameters with default
/// values are omitted.
std::string camera_text(const AnyCameraParameters& camera, const PixelFilter& filter);

/// The text of a scene with its camera replaced and everything else unchanged. Throws SceneError if it has no camera.
std::string with_camera(const Document& document, const std::string& camera);

}  // namespace phasetree::tracer
