#include "command/denoising.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "command/streams.hpp"
#include "denoise/denoise.hpp"
#include "denoise/open_image_denoise.hpp"
#include "output/error.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"

namespace phasetree::tracer {

namespace {

void keep_noisy(Image& image) {
    constexpr std::array names{"noisy.R", "noisy.G", "noisy.B"};
    for (int c = 0; c < 3; ++c) {
        Channel channel{names[static_cast<std::size_t>(c)], {}};
        channel.values.reserve(image.pixels.size());
        for (const glm::vec3& pixel : image.pixels) channel.values.push_back(pixel[c]);
        image.further.push_back(std::move(channel));
    }
}

}  // namespace

void add_denoise(CLI::App& command, std::optional<std::string>& denoise) {
    command.add_flag("--denoise{best}", denoise,
                     "Take noise out of the finished picture, guided by what the surfaces are like that it shows; the "
                     "result is smoother and biased. A .exr keeps what was sampled as noisy.R, noisy.G and noisy.B. By "
                     "Open Image Denoise where phasetree was "
                     "built with it, or --denoise=regression, which gives the same bits everywhere");
}

Denoiser denoiser_of(const std::string& text) {
    if (text == "best") return Denoiser::best;
    if (text == "regression") return Denoiser::regression;
    if (text != "oidn") throw OutputError(fmt::format("--denoise: \"regression\" or \"oidn\", not \"{}\"", text));
    if (!has_open_image_denoise()) throw OutputError("--denoise=oidn: phasetree was built without Open Image Denoise");
    return Denoiser::network;
}

void check_denoising(const Planes::Choice& kept, bool has_pictures) {
    if (!has_pictures) throw OutputError("--denoise is for pictures, and all outputs are .part files");
    if ((kept & denoising_planes()) != denoising_planes())
        throw OutputError("--denoise needs parts that were rendered with --denoise");
}

void denoise_picture(Image& image, const Denoising& how) {
    if (how.was_interrupted) {
        say("phasetree: interrupted; the image is not denoised\n");
        return;
    }
    LateProgress progress(ProgressOutput::standard_error(how.quiet), "denoising");
    DenoiseJob job;
    job.by = how.by;
    job.threads = how.threads;
    job.progress = [&](double done) { progress.tell(done); };
    job.cancelled = [] { return interrupted(); };
    try {
        std::optional<std::vector<glm::vec3>> pixels = denoise(image, job);
        if (!pixels) {
            say("phasetree: interrupted; the image is not denoised\n");
            return;
        }
        keep_noisy(image);
        image.pixels = std::move(*pixels);
    } catch (const DenoiseError& e) {
        say("phasetree: the image is not denoised: {}\n", e.what());
    }
}

void leave_out(Image& image, const Planes::Choice& kept, const Planes::Choice& wanted, const PlaneSubjects& subjects) {
    const std::vector<std::string> all = Planes::Sums(kept, subjects, 0).channels();
    const std::vector<std::string> some = Planes::Sums(wanted, subjects, 0).channels();
    std::erase_if(image.further, [&](const Channel& channel) {
        return std::ranges::count(all, channel.name) > 0 && std::ranges::count(some, channel.name) == 0;
    });
}

}  // namespace phasetree::tracer
