// Replaces open_image_denoise.cpp if the library is not available.
#include "denoise/open_image_denoise.hpp"

namespace phasetree::tracer {

bool has_open_image_denoise() {
    return false;
}

std::string open_image_denoise_version() {
    return "";
}

std::optional<std::vector<glm::vec3>> denoise_by_network(const Image&, const DenoiseJob&) {
    throw DenoiseError("phasetree was built without Open Image Denoise");
}

}  // namespace phasetree::tracer
