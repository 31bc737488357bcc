// Reads an environment image (image/read_image.hpp says of which formats).
#pragma once

#include <memory>
#include <string>

#include "lights/image_environment.hpp"

namespace phasetree::tracer {

/// A lat-long image, twice as wide as high (see lat_long.hpp for how it is oriented). Files that store integers, such
/// as PNG and JPEG, are taken to be sRGB-encoded, floating-point ones to be linear Rec.709, as is. Grey images are grey
/// light. Throws std::runtime_error with a message that names the file.
std::shared_ptr<const EnvironmentImage> load_environment_image(const std::string& path);

inline ImageEnvironment load_environment(const std::string& path, float rotation_degrees = 0.0f,
                                         float intensity = 1.0f) {
    return {load_environment_image(path), rotation_degrees, intensity};
}

}  // namespace phasetree::tracer
