// The data that all vertices and shadow rays of a path share.
#pragma once

#include "sampling/sobol.hpp"
#include "world/counters.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

class PhotonEmission;
class PhotonMap;

/// The photons that a path gathers, if there are any.
struct Photons {
    const PhotonEmission* emission = nullptr;
    const PhotonMap* map = nullptr;
    explicit operator bool() const { return map != nullptr; }
};

struct PathContext {
    const World& world;
    const Scene& scene;
    Photons photons;
    Sampler& sampler;
    PathCounters& counters;  ///< where rays and interactions are counted
};

}  // namespace phasetree::tracer
