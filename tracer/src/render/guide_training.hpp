// Trains the guide of a picture (guiding/guide.hpp) with paths from its camera, before the first pass. Each round has
// twice as many paths as the previous one, and uses the previous round's guide (Müller, Gross & Novák 2017, section 5).
// The samples of a round (light that its paths found, with the points and directions) are discarded after the next
// round, which has better ones. The guide depends only on the scene and the whole picture, so that an image does not
// depend on how it was divided.
//
// The number of paths is between two and four per pixel of the whole picture, but at least a quarter of a million and
// at most a million. Each has at most 16 samples of 32 bytes, so the samples of the last round take less than 300 MB.
// While they are gathered, some of them exist twice.
//
// With caustics, round i uses the photons of pass i. If anything moves, these are from a single time, so the guide
// describes moving lamps at one moment. The first passes use these photons again, weighted by a guide that was trained
// with them. That causes a bias, which decreases with the number of photons, like their blur.
#pragma once

#include <functional>
#include <optional>

#include "caustics/caustics.hpp"
#include "guiding/guide.hpp"
#include "render/camera_paths.hpp"

namespace phasetree::tracer {

struct GuideTraining {
    const World& world;
    const Scene& scene;
    const CameraPaths& cameras;
    const Caustics* caustics = nullptr;          ///< photons for the paths, if any
    const std::function<void(double)>& learned;  ///< RenderJob::learned
    const std::function<bool()>& cancelled;      ///< called from any thread
};

/// Uses all threads of the calling arena. Returns nullopt if it was cancelled.
std::optional<Guide> trained_guide(const GuideTraining& training);

}  // namespace phasetree::tracer
