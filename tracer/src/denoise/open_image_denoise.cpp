#include "denoise/open_image_denoise.hpp"

#include <fmt/format.h>
#include <OpenImageDenoise/oidn.hpp>

#include <array>

#include "denoise/channels.hpp"

namespace phasetree::tracer {

namespace {

std::vector<glm::vec3> joined(const Image& image, const std::array<const char*, 3>& names) {
    std::vector<glm::vec3> values(image.pixels.size());
    for (int c = 0; c < 3; ++c) {
        const std::span<const float> channel = channel_of(image, names[static_cast<std::size_t>(c)]);
        for (std::size_t i = 0; i < values.size(); ++i) values[i][c] = channel[i];
    }
    return values;
}

// Called by the library from C, so it must not throw.
bool goes_on(void* job, double done) noexcept {
    try {
        const auto& of = *static_cast<const DenoiseJob*>(job);
        of.progress(done);
        return !of.cancelled();
    } catch (...) {
        return false;
    }
}

}  // namespace

bool has_open_image_denoise() {
    return true;
}

std::string open_image_denoise_version() {
    return fmt::format("{}.{}.{}", OIDN_VERSION_MAJOR, OIDN_VERSION_MINOR, OIDN_VERSION_PATCH);
}

std::optional<std::vector<glm::vec3>> denoise_by_network(const Image& image, const DenoiseJob& job) {
    std::vector<glm::vec3> color = image.pixels, clean(image.pixels.size());
    std::vector<glm::vec3> albedo = joined(image, {"albedo_behind.R", "albedo_behind.G", "albedo_behind.B"});
    std::vector<glm::vec3> normal = joined(image, {"normal_behind.X", "normal_behind.Y", "normal_behind.Z"});
    // A CPU device, which accesses memory of the application directly.
    oidn::DeviceRef device = oidn::newDevice(oidn::DeviceType::CPU);
    if (job.threads > 0) device.set("numThreads", job.threads);
    device.commit();
    oidn::FilterRef filter = device.newFilter("RT");
    const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
    const auto set = [&](const char* name, std::vector<glm::vec3>& pixels) {
        filter.setImage(name, pixels.data(), oidn::Format::Float3, width, height);
    };
    set("color", color);
    set("albedo", albedo);
    set("normal", normal);
    set("output", clean);
    filter.set("hdr", true);
    DenoiseJob of_filter = job;
    filter.setProgressMonitorFunction(goes_on, &of_filter);
    filter.commit();
    filter.execute();
    const char* message = nullptr;
    const oidn::Error error = device.getError(message);
    if (error == oidn::Error::Cancelled) return std::nullopt;
    if (error != oidn::Error::None) throw DenoiseError(fmt::format("Open Image Denoise: {}", message));
    return clean;
}

}  // namespace phasetree::tracer
