// Making a guide for a picture (guiding/guide.hpp) by paths from its camera, before the first pass: in rounds, each of
// twice as many paths, which the guide of the round before helps already (Müller, Gross & Novák 2017, section 5). What
// a round found is forgotten after the next, which knows it better. The guide follows from the scene and the whole
// picture alone, so that an image does not depend on how it was divided.
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
    const Caustics* caustics = nullptr;  ///< help the paths where there are any
    PathCounters& counters;
    const std::function<void(double)>& learned;  ///< RenderJob::learned
    const std::function<bool()>& cancelled;      ///< asked from any thread
};

/// How many paths there are in all rounds, which is what time and memory grow with: four for each pixel of the picture
/// at most, but a quarter of a million at least and two million at most.
std::size_t training_paths(const Scene& scene);

/// Uses all threads of the arena that it is called in. Nothing if it was cancelled.
std::optional<Guide> trained_guide(const GuideTraining& training);

}  // namespace phasetree::tracer
