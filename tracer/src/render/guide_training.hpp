// A guide for a picture (guiding/guide.hpp) is learnt by paths from its camera, before the first pass: in rounds, each
// of twice as many paths, which the guide of the round before helps already (Müller, Gross & Novák 2017, section 5).
// What a round found is forgotten after the next, which knows it better. The guide follows from the scene and the whole
// picture alone, so that an image does not depend on how it was divided.
//
// There are between two and four paths for each pixel of the whole picture, but never fewer than a quarter of a million
// nor more than a million. Each has 16 findings of 32 bytes at most, so the findings of the last round take less than
// 300 MB, and while they are gathered some of them are there twice.
//
// With caustics, round i has the photons of pass i, and so one moment if anything moves: a guide of moving lamps knows
// where their light was at one moment. Those passes weigh their photons by a guide that has seen the same photons, a
// bias that goes with the number of photons, as their blur does.
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

/// Uses all threads of the arena that it is called in. Returns nothing if it was cancelled.
std::optional<Guide> trained_guide(const GuideTraining& training);

}  // namespace phasetree::tracer
