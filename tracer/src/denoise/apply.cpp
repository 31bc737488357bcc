#include "denoise/apply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "denoise/open_image_denoise.hpp"

namespace phasetree::tracer {

namespace {

void keep_noisy(Image& image) {
    constexpr std::array names{"noisy.R", "noisy.G", "noisy.B"};
    for (int c = 0; c < 3; ++c) {
        Channel channel{names[static_cast<std::size_t>(c)], {}};
        channel.values.reserve(image.pixels.size());
        for (const glm::vec3& pixel : image.pixels) channel.values.push_back(pixel[c]);
        image.extra_channels.push_back(std::move(channel));
    }
}

}  // namespace

Denoiser denoiser_named(const std::string& name) {
    if (name == "best") return Denoiser::best;
    if (name == "regression") return Denoiser::regression;
    if (name != "oidn") throw DenoiseError(fmt::format("must be \"regression\" or \"oidn\", but is \"{}\"", name));
    if (!has_open_image_denoise()) throw DenoiseError("phasetree was built without Open Image Denoise");
    return Denoiser::network;
}

void check_samples_to_denoise(int samples) {
    if (samples < fewest_samples_to_denoise)
        throw DenoiseError(fmt::format("needs at least {} samples per pixel, but the picture has {}",
                                       fewest_samples_to_denoise, samples));
}

bool denoise_in_place(Image& image, const DenoiseJob& job) {
    std::optional<std::vector<glm::vec3>> pixels = denoise(image, job);
    if (!pixels) return false;
    keep_noisy(image);
    image.pixels = std::move(*pixels);
    return true;
}

void leave_out(Image& image, const Planes::Choice& kept, const Planes::Choice& wanted, const SceneNames& scene_names) {
    const std::vector<std::string> all = Planes::Sums(kept, scene_names, 0).channels();
    const std::vector<std::string> some = Planes::Sums(wanted, scene_names, 0).channels();
    std::erase_if(image.extra_channels, [&](const Channel& channel) {
        return std::ranges::count(all, channel.name) > 0 && std::ranges::count(some, channel.name) == 0;
    });
}

}  // namespace phasetree::tracer
