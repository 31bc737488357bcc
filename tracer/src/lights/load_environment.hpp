// Reads environment images (see image/read_image.hpp for formats).
#pragma once

#include <memory>
#include <string>

#include "lights/image_environment.hpp"

namespace phasetree::tracer {

/// Reads a lat-long image, twice as wide as high (see lat_long.hpp for its orientation). Integer files, such as PNG and
/// JPEG, are decoded as sRGB; floating-point files are linear Rec.709. Grey images result in grey light. Throws
/// std::runtime_error with a message that names the file.
std::shared_ptr<const EnvironmentImage> load_environment_image(const std::string& path);

inline ImageEnvironment load_environment(const std::string& path, float rotation_degrees = 0.0f,
                                         float intensity = 1.0f) {
    return {load_environment_image(path), rotation_degrees, intensity};
}

}  // namespace phasetree::tracer
