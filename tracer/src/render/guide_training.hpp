// Making a guide for a picture (guiding/guide.hpp) by paths from its camera, before the first pass: in rounds, each of
// twice as many paths, which the guide of the round before helps already (Müller, Gross & Novák 2017, section 5). What
// a round found is forgotten after the next, which knows it better. The guide follows from the scene and the whole
// picture alone, so that an image does not depend on how it was divided. There are up to four paths for each pixel of
// the whole picture, a quarter of a million at least and a million at most, which report 16 places each at most, of 32
// bytes; so findings take less than 300 MB.
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
    const Caustics* caustics = nullptr;          ///< help the paths where there are any
    const std::function<void(double)>& learned;  ///< RenderJob::learned
    const std::function<bool()>& cancelled;      ///< asked from any thread
};

/// Uses all threads of the arena that it is called in. Nothing if it was cancelled.
std::optional<Guide> trained_guide(const GuideTraining& training);

}  // namespace phasetree::tracer
