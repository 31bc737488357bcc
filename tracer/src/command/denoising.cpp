#include "command/denoising.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "command/option_error.hpp"
#include "command/streams.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"

namespace phasetree::tracer {

namespace {

// Calls f, and prefixes its errors with the option's name.
template <class F>
auto as_option(F&& f) {
    try {
        return f();
    } catch (const DenoiseError& e) {
        throw OptionError(fmt::format("--denoise: {}", e.what()));
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
    return as_option([&] { return denoiser_named(text); });
}

void check_denoising(const std::string& denoise, int samples) {
    (void)denoiser_of(denoise);
    as_option([&] { check_samples_to_denoise(samples); });
}

void check_denoising(const Planes::Choice& kept, bool has_pictures) {
    if (!has_pictures) throw OptionError("--denoise is for pictures, and all outputs are .part files");
    if ((kept & denoising_planes()) != denoising_planes())
        throw OptionError("--denoise needs parts that were rendered with --denoise");
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
        if (!denoise_in_place(image, job)) say("phasetree: interrupted; the image is not denoised\n");
    } catch (const DenoiseError& e) {
        say("phasetree: the image is not denoised: {}\n", e.what());
    }
}

}  // namespace phasetree::tracer
