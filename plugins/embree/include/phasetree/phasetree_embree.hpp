/// C++17 wrapper of phasetree_embree.h: handles are reference-counted objects, and errors are exceptions. Each member
/// function calls the corresponding C function, whose documentation describes units, thread safety and lifetimes.
/// Failed calls throw Error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "phasetree/phasetree_embree.h"

namespace phasetree::embree {

/// Thrown by a failed call. what() is the text of phasetreeGetErrorMessage().
class Error : public std::runtime_error {
  public:
    explicit Error(PhasetreeError code) : std::runtime_error(phasetreeGetErrorMessage()), code_(code) {}
    PhasetreeError code() const { return code_; }

  private:
    PhasetreeError code_;
};

/// Throw Error unless the code is PHASETREE_ERROR_NONE.
inline void check(PhasetreeError error) {
    if (error != PHASETREE_ERROR_NONE) throw Error(error);
}

/// An owning reference to a handle. Copies add a reference.
template <class Handle, PhasetreeError (*retain)(Handle), PhasetreeError (*release)(Handle)>
class Reference {
  public:
    Reference() = default;
    /// Take ownership of a reference.
    explicit Reference(Handle handle) : handle_(handle) {}
    Reference(const Reference& other) : handle_(other.handle_) {
        if (handle_) check(retain(handle_));
    }
    Reference(Reference&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Reference& operator=(Reference other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Reference() {
        if (handle_) release(handle_);
    }

    Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != nullptr; }

  private:
    Handle handle_ = nullptr;
};

/// A convex volume around some phases: their points lie behind every plane.
struct CarvedBounds : PhasetreeCarvedBounds {
    std::vector<PhasetreePlane> planes;
};

/// An owning copy of a PhasetreeMesh.
struct Mesh {
    std::vector<float> vertices;
    std::vector<unsigned> indices;
    std::vector<unsigned char> behind, front;
    float spacing = 0;
    std::size_t crossings = 0, skipped = 0;
};

inline PhasetreeMeshOptions default_mesh_options() {
    PhasetreeMeshOptions options;
    phasetreeInitMeshOptions(&options);
    return options;
}

inline PhasetreeCarveOptions default_carve_options() {
    PhasetreeCarveOptions options;
    phasetreeInitCarveOptions(&options);
    return options;
}

/// A tree. Immutable, and cheap to copy.
class Tree {
  public:
    static Tree from_file(const std::string& path, const PhasetreeFileReader* reader = nullptr) {
        PhasetreeTree handle = nullptr;
        check(phasetreeNewTreeFromFile(PHASETREE_API_VERSION, path.c_str(), reader, &handle));
        return Tree(handle);
    }
    static Tree from_text(std::string_view text, const std::string& name = "<text>",
                          const PhasetreeFileReader* reader = nullptr) {
        PhasetreeTree handle = nullptr;
        check(phasetreeNewTreeFromText(PHASETREE_API_VERSION, text.data(), text.size(), name.c_str(), reader, &handle));
        return Tree(handle);
    }
    /// Convert a phasetree::SceneTree built with the C++ library. Include <phasetree/io/write.hpp> to use it. The tree
    /// is passed as text, without loss, so the two libraries need not be binary compatible. Files named by its nodes
    /// are resolved relative to the folder of `name`.
    template <class SceneTree>
    static Tree of(const SceneTree& tree, const std::string& name = "<tree>",
                   const PhasetreeFileReader* reader = nullptr) {
        return from_text(write_tree_without_materials(tree), name, reader);
    }

    Tree edited(const std::string& path, const std::string& value) const {
        PhasetreeTree handle = nullptr;
        check(phasetreeNewEditedTree(get(), path.c_str(), value.c_str(), &handle));
        return Tree(handle);
    }
    unsigned phase_count() const {
        unsigned count = 0;
        check(phasetreeGetTreePhaseCount(get(), &count));
        return count;
    }
    std::string phase_name(unsigned phase) const {
        const char* name = nullptr;
        check(phasetreeGetTreePhaseName(get(), phase, &name));
        return name;
    }
    unsigned phase(const std::string& name) const {
        unsigned phase = 0;
        check(phasetreeGetTreePhaseByName(get(), name.c_str(), &phase));
        return phase;
    }
    /// The phase's material as JSON; nullopt if the scene has none.
    std::optional<std::string> phase_material(unsigned phase) const {
        const char* json = nullptr;
        check(phasetreeGetTreePhaseMaterial(get(), phase, &json));
        return json ? std::optional<std::string>(json) : std::nullopt;
    }
    RTCBounds bounds() const {
        RTCBounds box{};
        check(phasetreeGetTreeBounds(get(), &box));
        return box;
    }
    CarvedBounds carved(PhasetreePhaseSet phases = PHASETREE_ALL_PHASES,
                        const PhasetreeCarveOptions& options = default_carve_options()) const {
        CarvedBounds carved{};
        carved.planes.resize(options.maxPlanes);
        unsigned count = 0;
        check(phasetreeCarveTree(get(), phases, &options, carved.planes.data(), &count, &carved));
        carved.planes.resize(count);
        return carved;
    }
    PhasetreeTree get() const { return reference_.get(); }

  private:
    explicit Tree(PhasetreeTree handle) : reference_(handle) {}
    Reference<PhasetreeTree, phasetreeRetainTree, phasetreeReleaseTree> reference_;
};

inline PhasetreeGeometryOptions default_options() {
    PhasetreeGeometryOptions options;
    phasetreeInitGeometryOptions(&options);
    return options;
}

/// Data stored for a phase by the application.
struct PhaseUserData {
    std::int64_t integer = 0;
    void* pointer = nullptr;
};

/// A geometry. Copies share it. It must outlive the scenes that contain its RTCGeometry.
class Geometry {
  public:
    Geometry(RTCDevice device, const Tree& tree, const PhasetreeGeometryOptions& options = default_options())
        : reference_(make(device, tree, options)) {}

    /// Create a geometry from cells that write_cells() wrote for a geometry with the same tree and options.
    static Geometry from_cells(RTCDevice device, const Tree& tree, const std::string& path,
                               const PhasetreeGeometryOptions& options = default_options()) {
        PhasetreeGeometry geometry = nullptr;
        check(phasetreeNewGeometryFromCells(PHASETREE_API_VERSION, device, tree.get(), &options, path.c_str(),
                                            &geometry));
        return Geometry(geometry);
    }
    void write_cells(const std::string& path) const { check(phasetreeWriteGeometryCells(get(), path.c_str())); }

    /// The RTCGeometry, uncommitted. Owned by the handle.
    RTCGeometry embree() const {
        RTCGeometry geometry = nullptr;
        check(phasetreeGetEmbreeGeometry(get(), &geometry));
        return geometry;
    }
    void set_user_data(void* pointer) { check(phasetreeSetGeometryUserData(get(), pointer)); }
    void* user_data() const {
        void* pointer = nullptr;
        check(phasetreeGetGeometryUserData(get(), &pointer));
        return pointer;
    }
    void set_phase_user_data(unsigned phase, const PhaseUserData& data) {
        check(phasetreeSetGeometryPhaseUserData(get(), phase, data.integer, data.pointer));
    }
    PhaseUserData phase_user_data(unsigned phase) const {
        PhaseUserData data;
        check(phasetreeGetGeometryPhaseUserData(get(), phase, &data.integer, &data.pointer));
        return data;
    }
    /// Mesh the interfaces.
    Mesh mesh(const PhasetreeMeshOptions& options = default_mesh_options()) const {
        struct Copy {
            Mesh mesh;
            std::exception_ptr failed;  // exceptions must not propagate through the library
        } copy;
        const auto receive = [](const PhasetreeMesh* m, void* to) {
            Copy& c = *static_cast<Copy*>(to);
            try {
                c.mesh = {{m->vertices, m->vertices + 3 * m->vertexCount},
                          {m->indices, m->indices + 3 * m->triangleCount},
                          {m->behind, m->behind + m->triangleCount},
                          {m->front, m->front + m->triangleCount},
                          m->spacing,
                          m->crossings,
                          m->skipped};
            } catch (...) {
                c.failed = std::current_exception();
            }
        };
        check(phasetreeMakeGeometryMesh(get(), &options, receive, &copy));
        if (copy.failed) std::rethrow_exception(copy.failed);
        return std::move(copy.mesh);
    }
    void set_tree(const Tree& tree, const PhasetreeGeometryOptions& options = default_options()) {
        check(phasetreeSetGeometryTree(get(), tree.get(), &options));
    }
    void set_shown_phases(PhasetreePhaseSet shown) { check(phasetreeSetGeometryShownPhases(get(), shown)); }
    void set_motion(const std::vector<std::array<float, 12>>& transforms, float start = 0, float end = 1) {
        check(phasetreeSetGeometryMotion(get(), transforms.empty() ? nullptr : transforms.front().data(),
                                         static_cast<unsigned>(transforms.size()), start, end));
    }
    PhasetreeGeometryStatistics statistics() const {
        PhasetreeGeometryStatistics statistics{};
        check(phasetreeGetGeometryStatistics(get(), &statistics));
        return statistics;
    }

    std::string warning() const {
        const char* warning = nullptr;
        check(phasetreeGetGeometryWarning(get(), &warning));
        return warning;
    }

    PhasetreeHit decode(const RTCRayHit& rayhit, const float* object_to_world = nullptr) const {
        PhasetreeHit hit{};
        check(phasetreeDecodeHit(get(), &rayhit, object_to_world, &hit));
        return hit;
    }
    /// Transforms the position of a hit to the tree's own space. The overload below transforms a point in geometry
    /// space.
    std::array<float, 3> tree_point(const RTCRayHit& rayhit, const float* object_to_world = nullptr) const {
        std::array<float, 3> point{};
        check(phasetreeGetHitTreePoint(get(), &rayhit, object_to_world, point.data()));
        return point;
    }
    std::array<float, 3> tree_point(const std::array<float, 3>& point, float time = 0) const {
        std::array<float, 3> there{};
        check(phasetreeGetTreePoint(get(), point.data(), time, there.data()));
        return there;
    }
    unsigned phase(const std::array<float, 3>& point, float time = 0, float* empty_radius = nullptr) const {
        unsigned phase = 0;
        check(phasetreeGetPhase(get(), point.data(), time, &phase, empty_radius));
        return phase;
    }
    std::array<float, PHASETREE_MAX_PHASES> distances(const std::array<float, 3>& point, float time = 0) const {
        std::array<float, PHASETREE_MAX_PHASES> all{};
        check(phasetreeGetDistances(get(), point.data(), time, all.data()));
        return all;
    }
    /// The phases of many points at one time. If `empty_radii` is not null, it receives the radius around each point
    /// within which the phase does not change.
    std::vector<unsigned> phases(const std::vector<std::array<float, 3>>& points, float time = 0,
                                 std::vector<float>* empty_radii = nullptr) const {
        std::vector<unsigned> all(points.size());
        if (empty_radii) empty_radii->resize(points.size());
        const PhasetreePoints p = listed(points, time);
        check(phasetreeGetPhaseN(get(), &p, all.data(), empty_radii ? empty_radii->data() : nullptr));
        return all;
    }
    /// Φ of the phases 0 … phase_count − 1 at each point, point by point.
    std::vector<float> distances(const std::vector<std::array<float, 3>>& points, unsigned phase_count,
                                 float time = 0) const {
        std::vector<float> all(points.size() * phase_count);
        const PhasetreePoints p = listed(points, time);
        check(phasetreeGetDistancesN(get(), &p, phase_count, all.data(), sizeof(float) * phase_count, sizeof(float)));
        return all;
    }
    PhasetreeClosest closest(const std::array<float, 3>& point, float radius, float tolerance = 0.01f,
                             float time = 0) const {
        PhasetreeClosest closest{};
        check(phasetreeFindClosestInterface(get(), point.data(), time, radius, tolerance, &closest));
        return closest;
    }
    PhasetreeGeometry get() const { return reference_.get(); }

  private:
    explicit Geometry(PhasetreeGeometry handle) : reference_(handle) {}
    /// The result refers to both arguments, which must outlive it.
    static PhasetreePoints listed(const std::vector<std::array<float, 3>>& points, const float& time) {
        PhasetreePoints p;
        phasetreeInitPoints(&p);
        p.count = points.size();
        if (!points.empty()) {
            p.x = points.front().data();
            p.y = p.x + 1;
            p.z = p.x + 2;
        }
        p.stride = sizeof points.front();
        p.time = &time;
        p.timeStride = 0;
        return p;
    }
    static PhasetreeGeometry make(RTCDevice device, const Tree& tree, const PhasetreeGeometryOptions& options) {
        PhasetreeGeometry geometry = nullptr;
        check(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree.get(), &options, &geometry));
        return geometry;
    }
    Reference<PhasetreeGeometry, phasetreeRetainGeometry, phasetreeReleaseGeometry> reference_;
};

}  // namespace phasetree::embree
