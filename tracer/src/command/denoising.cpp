#include "command/denoising.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "command/errors.hpp"
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
        throw UsageError(fmt::format("--denoise: {}", e.what()));
    }
}

}  // namespace

void add_denoise(CLI::App& command, std::optional<std::string>& denoise) {
    command.add_flag(
        "--denoise{best}", denoise,
        "Denoise the finished picture, which makes it smoother but biased. An .exr keeps the noisy picture "
        "as noisy.R, noisy.G and noisy.B. Uses Open Image Denoise if phasetree was built with it; "
        "--denoise=regression gives the same bits on every machine");
}

Denoiser denoiser_of(const std::string& text) {
    return as_option([&] { return denoiser_named(text); });
}

void check_denoising(const std::string& denoise, int samples) {
    (void)denoiser_of(denoise);
    as_option([&] { check_samples_to_denoise(samples); });
}

void check_denoising(const Planes::Choice& kept, bool has_pictures) {
    if (!has_pictures) throw UsageError("--denoise needs a picture to write, but all outputs are .part files");
    if ((kept & denoising_planes()) != denoising_planes())
        throw UsageError("--denoise needs parts that were rendered with --denoise; render them again with it");
}

void denoise_picture(Image& image, const Denoising& how) {
    if (how.was_interrupted) {
        say("phasetree: interrupted; the picture is not denoised\n");
        return;
    }
    LateProgress progress(ProgressOutput::standard_error(how.quiet), "denoising");
    DenoiseJob job;
    job.by = how.by;
    job.threads = how.threads;
    job.progress = [&](double done) { progress.tell(done); };
    job.cancelled = [] { return interrupted(); };
    try {
        if (!denoise_in_place(image, job)) say("phasetree: interrupted; the picture is not denoised\n");
    } catch (const DenoiseError& e) {
        say("phasetree: warning: the picture is not denoised: {}\n", e.what());
    }
}

}  // namespace phasetree::tracer
