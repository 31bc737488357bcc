// Denoising of pictures for --denoise.
#pragma once

#include <optional>
#include <string>

#include "denoise/apply.hpp"
#include "film/image.hpp"
#include "film/planes.hpp"

namespace CLI {
class App;
}

namespace phasetree::tracer {

// Adds the option --denoise. Without it, pictures are not denoised.
void add_denoise(CLI::App& command, std::optional<std::string>& denoise);
// Parses the option's value. Throws UsageError.
Denoiser denoiser_of(const std::string& text);

// Checks that a picture with this many samples per pixel, over all shares, can be denoised as requested. Throws
// UsageError.
void check_denoising(const std::string& denoise, int samples);
// Checks that a film with these planes can be denoised, and that a picture is to be written. Throws UsageError.
void check_denoising(const Planes::Choice& kept, bool has_pictures);

struct Denoising {
    Denoiser by = Denoiser::best;
    int threads = 0;
    bool quiet = false;
    bool was_interrupted = false;  ///< if set, return as soon as possible
};

// Denoises a picture that has the channels of denoising_planes(). The noisy colours are kept in the additional channels
// noisy.R, .G and .B. If denoising fails, or a signal stops it, reports that and leaves the picture unchanged.
void denoise_picture(Image& image, const Denoising& how);

}  // namespace phasetree::tracer
