// Rays for a field and for the mesh that would replace it.
#pragma once

#include <cstdint>

#include "trace/field_scene.hpp"
#include "trace/mesh_scene.hpp"

namespace phasetree::bench {

// Rays that leave the surface: the field's from the near end of its bracket, the mesh's from its own hit of the same
// camera ray, lifted by a hair as is usual with meshes. The directions are the same, and random over the hemisphere.
struct SurfaceRays {
    Rays of_field, of_mesh;
};

struct Agreement {
    std::size_t both = 0, either = 0;
    double difference = 0, largest = 0;

    double share() const { return either == 0 ? 0 : static_cast<double>(both) / static_cast<double>(either); }
    double mean() const { return both == 0 ? 0 : difference / static_cast<double>(both); }
};

// What both find along the same rays.
Agreement compare(const FieldScene& field, const MeshScene& mesh, const Rays& rays);

// As many rays as camera rays, from where those hit both.
SurfaceRays leaving(const FieldScene& field, const MeshScene& mesh, const Rays& camera, std::uint64_t seed);

}  // namespace phasetree::bench
