// Intel's Open Image Denoise, a neural network, if it was found when phasetree was built. It is guided by the albedo
// and the normal of the first surface that is not perfectly smooth, and ignores the halves. Results may differ between
// machines and between versions of the library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "denoise/denoise.hpp"

namespace phasetree::tracer {

bool has_open_image_denoise();
/// The version of Open Image Denoise; empty if this program was built without it.
std::string open_image_denoise_version();

/// See denoise(). Throws DenoiseError, also if has_open_image_denoise() is false.
std::optional<std::vector<glm::vec3>> denoise_by_network(const Image& image, const DenoiseJob& job);

}  // namespace phasetree::tracer
