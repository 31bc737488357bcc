// A picture with less noise, from its own samples: first-order regression on what the surfaces are like that it shows.
//
// 1. The features (halves.hpp) are freed of their own noise (features.hpp).
// 2. Around each pixel p a window of pixels q is weighed by how much alike their surroundings are (similarity.hpp), and
//    a linear model of the radiance by the features is fitted to it (regression.hpp). The radiance is that of one half
//    of the samples and the weights are by the other half, so that no sample chooses itself.
// 3. A model holds for all of its window: a pixel takes the weighted mean of what the models around it say of it.
// 4. Both halves are filtered like this, and joined by how many samples each has. Glints (glints.hpp) stay as they are.
//
// So edges of objects and of textures stay as sharp as the features have them, in mirrors and behind glass as well.
// What the features do not show, as shadows and caustics, is kept by the weights, which know the noise and keep what is
// above it. The result is biased, as that of every such filter is. It is the same for any number of threads.
//
// Source: Bitterli, Rousselle, Moon, Iglesias-Guitián, Adler, Mitchell, Jarosz & Novák, Nonlinearly Weighted
// First-order Regression for Denoising Monte Carlo Renderings, Computer Graphics Forum 35(4), 2016. Here the weights
// are applied in one pass, and the features are the albedo and the normal of the first
// surface and of the first that is not smooth (halves.hpp).
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

/// With fewer a pixel may lack one of the halves.
inline constexpr int fewest_samples_to_denoise = 8;

/// What a film has to keep to be denoised.
Planes::Choice denoising_planes();

/// How it is done.
enum class Denoiser {
    best,        ///< by the network if there is one, else by regression
    regression,  ///< as above
    network      ///< open_image_denoise.hpp
};

struct DenoiseJob {
    Denoiser by = Denoiser::best;
    int threads = 0;  ///< 0: as many as there are cores
    /// Called with how much is done, from 0 to 1, by one thread at a time.
    std::function<void(double)> progress = [](double) {};
    std::function<bool()> cancelled = [] { return false; };
};

/// The radiance of each pixel instead of image.pixels; nothing if it was cancelled. The image has the channels of
/// denoising_planes(). Takes some 300 bytes a pixel. Throws DenoiseError if a channel or samples are missing.
std::optional<std::vector<glm::vec3>> denoise(const Image& image, const DenoiseJob& job = {});

}  // namespace phasetree::tracer
