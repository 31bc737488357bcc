// Denoises a picture by first-order regression of its samples on features of the visible surfaces.
//
// 1. The features (halves.hpp) are denoised themselves (features.hpp).
// 2. In a window around each pixel p, pixels q are weighted by the similarity of their neighbourhoods (similarity.hpp),
//    and a linear model of the radiance by the features is fitted (regression.hpp). The radiance is that of one half of
//    the samples, and the weights are from the other half, so that no sample affects its own weight.
// 3. A model applies to its whole window: a pixel is the weighted mean of the predictions by the models around it.
// 4. Both halves are filtered in this way, and joined in proportion to their numbers of samples. Glints (glints.hpp)
//    are not changed.
//
// So edges of objects and of textures stay as sharp as in the features, including those in mirrors and behind glass.
// Details that the features do not show, such as shadows and caustics, are preserved by the weights, which keep
// differences that exceed the noise. The result is biased, like that of any such filter. It does not depend on the
// number of threads.
//
// Source: Bitterli, Rousselle, Moon, Iglesias-Guitián, Adler, Mitchell, Jarosz & Novák, Nonlinearly Weighted
// First-order Regression for Denoising Monte Carlo Renderings, Computer Graphics Forum 35(4), 2016. Here the weights
// are applied in one pass, and the features are the albedo and the normal of the first surface and of the first that is
// not smooth (halves.hpp).
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>

#include "film/image.hpp"
#include "film/planes.hpp"

namespace phasetree::tracer {

class DenoiseError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// With fewer samples, one of the halves of a pixel may be empty.
inline constexpr int fewest_samples_to_denoise = 8;

/// The planes that a film needs for denoising.
Planes::Choice denoising_planes();

/// The algorithm.
enum class Denoiser {
    best,        ///< the network if it is built in, otherwise regression
    regression,  ///< as described above
    network      ///< open_image_denoise.hpp
};

struct DenoiseJob {
    Denoiser by = Denoiser::best;
    int threads = 0;  ///< 0: as many as there are cores
    /// Called with the progress, from 0 to 1, by one thread at a time.
    std::function<void(double)> progress = [](double) {};
    std::function<bool()> cancelled = [] { return false; };
};

/// Returns the radiance of each pixel, to replace image.pixels; nullopt if it was cancelled. The image must have the
/// channels of denoising_planes(). Takes some 300 bytes per pixel. Throws DenoiseError if a channel or samples are
/// missing.
std::optional<std::vector<glm::vec3>> denoise(const Image& image, const DenoiseJob& job = {});

}  // namespace phasetree::tracer
