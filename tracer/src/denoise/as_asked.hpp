// Denoising as people ask for it, on the command line and in Python: by a name, of a picture with the planes that they
// want.
#pragma once

#include <string>

#include "denoise/denoise.hpp"
#include "film/image.hpp"
#include "film/planes.hpp"

namespace phasetree::tracer {

/// "best", "regression" or "oidn". Throws DenoiseError if there is no such denoiser, or it is not built in.
Denoiser denoiser_named(const std::string& name);

/// Throws DenoiseError if a picture of this many samples a pixel has too few.
void check_samples_to_denoise(int samples);

/// Puts the denoised picture instead of the image's, which becomes the further channels noisy.R, .G and .B. Returns
/// whether it is done; if it was cancelled the image is as it was. Throws DenoiseError as denoise() does.
bool denoise_in_place(Image& image, const DenoiseJob& job);

/// Takes out the further channels that the planes of `kept` have and those of `wanted` do not.
void leave_out(Image& image, const Planes::Choice& kept, const Planes::Choice& wanted, const PlaneSubjects& subjects);

}  // namespace phasetree::tracer
