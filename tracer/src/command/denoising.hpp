// Pictures with less noise, as --denoise makes them.
#pragma once

#include <optional>
#include <string>

#include "denoise/as_asked.hpp"
#include "film/image.hpp"
#include "film/planes.hpp"

namespace CLI {
class App;
}

namespace phasetree::tracer {

// Where it is not asked for there is none.
void add_denoise(CLI::App& command, std::optional<std::string>& denoise);
// How it is asked for. Throws OutputError.
Denoiser denoiser_of(const std::string& text);

// Makes sure that a picture of this many samples a pixel, those of all shares together, can be denoised as it is asked
// for. Throws OutputError.
void check_denoising(const std::string& denoise, int samples);
// Makes sure that a film of these planes can be denoised, and that there is to be a picture of it. Throws OutputError.
void check_denoising(const Planes::Choice& kept, bool has_pictures);

struct Denoising {
    Denoiser by = Denoiser::best;
    int threads = 0;
    bool quiet = false;
    bool was_interrupted = false;  ///< then nobody is to wait any longer
};

// Denoises a picture, which has the channels of denoising_planes(), and keeps in the further channels noisy.R, .G and
// .B what it was. Where that cannot be done, or a signal stops it, says so and leaves the picture as it is.
void denoise_picture(Image& image, const Denoising& how);

}  // namespace phasetree::tracer
