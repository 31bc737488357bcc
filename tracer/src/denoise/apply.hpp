// Denoising for the command line and Python: by name, and for a picture with selected planes.
#pragma once

#include <string>

#include "denoise/denoise.hpp"
#include "film/image.hpp"
#include "film/planes.hpp"

namespace phasetree::tracer {

/// "best", "regression" or "oidn". Throws DenoiseError if there is no such denoiser, or if it is not built in.
Denoiser denoiser_named(const std::string& name);

/// Throws DenoiseError if this number of samples per pixel is too small.
void check_samples_to_denoise(int samples);

/// Replaces the image's picture by the denoised one, and adds the original as the further channels noisy.R, .G and .B.
/// Returns false if it was cancelled, in which case the image is unchanged. Throws DenoiseError as denoise() does.
bool denoise_in_place(Image& image, const DenoiseJob& job);

/// Removes the further channels that belong to planes in `kept` but not in `wanted`.
void leave_out(Image& image, const Planes::Choice& kept, const Planes::Choice& wanted, const SceneNames& scene_names);

}  // namespace phasetree::tracer
