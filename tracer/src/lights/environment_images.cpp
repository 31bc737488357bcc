#include "lights/environment_images.hpp"

#include "lights/load_environment.hpp"

namespace phasetree::tracer {

std::shared_ptr<const EnvironmentImage> EnvironmentImages::get(const std::filesystem::path& file) {
    std::error_code problem;
    const std::filesystem::path real = std::filesystem::weakly_canonical(file, problem);
    auto& image = by_path_[problem ? file : real];
    if (!image) image = load_environment_image(file.string());
    return image;
}

ImageEnvironment ImageEnvironmentParameters::made(EnvironmentImages& images) const {
    try {
        return ImageEnvironment(images.get(file), rotation_degrees, intensity);
    } catch (const std::runtime_error& e) {
        throw ParameterError("file", e.what());
    }
}

}  // namespace phasetree::tracer
