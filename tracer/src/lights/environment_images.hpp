// The environment images of a scene. Each file is read once, however many lights use it.
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "lights/image_environment.hpp"

namespace phasetree::tracer {

class EnvironmentImages {
  public:
    // Throws std::runtime_error, whose what() describes the problem with the file.
    std::shared_ptr<const EnvironmentImage> get(const std::filesystem::path& file);

  private:
    std::map<std::filesystem::path, std::shared_ptr<const EnvironmentImage>> by_path_;
};

}  // namespace phasetree::tracer
