// The scene in Embree: the object as user geometry, and the meshes beside it; and what is found by rays beforehand.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "embree_core/cell_geometry.hpp"
#include "integrator/flat_boundaries.hpp"
#include "scene/scene.hpp"
#include "shading/interface.hpp"

namespace phasetree::tracer {

struct PathCounters {
    TraceCounters trace;
    std::uint64_t rays = 0;  // traced, for the path and for light
    std::uint64_t paths = 0;
    std::uint64_t interactions = 0;
};

// Where a ray that leaves a surface starts, for the cell that it starts in.
using Start = embree::StartHint;

// A place where a path is changed: an interface between two phases, or a mesh.
struct Surface {
    float distance = 0;
    glm::vec3 normal{0};  // unit; on the side the ray came from
    // Where a ray goes on that stays on this side, and one that passes through, in which phase.
    glm::vec3 near_origin{0};
    glm::vec3 far_origin{0};
    Phase near_phase;
    Phase far_phase;
    const Interface* optics = nullptr;
    Start start;  // for a ray from either origin, in its phase
};

// What a ray is for: one that looks for a light wants to know of a surface that is not clear how far it is, and no
// more; that has no optics then.
enum class Purpose { path, light };

// How the object is prepared; what is not said here is as CellOptions has it.
struct WorldOptions {
    BuildQuality quality = BuildQuality::medium;
    std::function<bool()> cancelled{};
    std::function<void(float)> progress{};
    std::size_t most_bytes = 0;
    std::optional<std::filesystem::path> kept_cells{};  // a file for the object's cells: see kept_cells.hpp
};

class World {
  public:
    // Refers to the scene, which must outlive it. Throws ModelError for an object that cannot be traced, BuildCancelled
    // once WorldOptions::cancelled says so.
    explicit World(const Scene& scene, const WorldOptions& = {});
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    // The nearest surface before `far` on a ray that carries a phase; direction of unit length; `start` is the
    // surface's that it leaves, if it does.
    std::optional<Surface> intersect(const glm::vec3& origin, const glm::vec3& direction, float far, Phase carried,
                                     const Start& start, Purpose purpose, PathCounters& counters) const;

    Phase label(const glm::vec3& p) const;
    const InterfaceCells& object() const { return *object_; }
    // The flat sides by which lamps shine into the object.
    const std::vector<FlatBoundary>& flat_boundaries() const { return flat_boundaries_; }
    // A length below which two points are the same place: what rays that leave a mesh are moved by.
    float hair() const { return hair_; }

  private:
    void add_mesh(const Mesh& mesh);
    Surface on_mesh(const RTCRayHit& ray, const glm::vec3& direction, Phase carried) const;

    const Scene& scene_;
    std::shared_ptr<const InterfaceCells> object_;
    RTCDevice device_ = nullptr;
    RTCScene embree_ = nullptr;
    std::optional<embree::CellGeometry> tree_;
    InterfaceTable interfaces_;
    std::vector<Interface> mesh_interfaces_;  // [mesh · phases + phase the ray is in]
    float hair_ = 0;
    std::vector<FlatBoundary> flat_boundaries_;
};

}  // namespace phasetree::tracer
