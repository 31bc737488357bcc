/// The C99 interface of phasetree_embree.h with owners for its handles and exceptions for its errors (C++17). Thin:
/// each member is the call of the same name there, where units, threads and what must outlive what are said.
#pragma once

#include <array>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "phasetree/phasetree_embree.h"

namespace phasetree::embree {

/// A call that failed; what() is phasetreeGetErrorMessage().
class Error : public std::runtime_error {
  public:
    explicit Error(PhasetreeError code) : std::runtime_error(phasetreeGetErrorMessage()), code_(code) {}
    PhasetreeError code() const { return code_; }

  private:
    PhasetreeError code_;
};

inline void check(PhasetreeError error) {
    if (error != PHASETREE_ERROR_NONE) throw Error(error);
}

/// One reference of a handle. Copies add one.
template <class Handle, PhasetreeError (*retain)(Handle), PhasetreeError (*release)(Handle)>
class Reference {
  public:
    Reference() = default;
    /// Takes over a reference.
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

/// Convex bounds: all of some phases is behind all planes.
struct CarvedBounds : PhasetreeCarvedBounds {
    std::vector<PhasetreePlane> planes;
};

/// A PhasetreeMesh that is one's own.
struct Mesh {
    std::vector<float> vertices;
    std::vector<unsigned> indices;
    std::vector<unsigned char> behind, front;
    float spacing = 0;
    std::size_t crossings = 0, passed_over = 0;
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

/// A tree: immutable, cheap to copy.
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
    /// A tree built with the C++ library: a phasetree::SceneTree. It comes over as text, equal to the last bit, so that
    /// the two libraries need not agree on anything else; include <phasetree/io/write.hpp>. Files that its nodes
    /// name are sought beside `name`.
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
    /// JSON; nothing if the scene has none.
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
        carved.planes.resize(options.mostPlanes);
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

/// An application's own of a phase.
struct PhaseUserData {
    std::int64_t integer = 0;
    void* pointer = nullptr;
};

/// A geometry. A copy is another owner of the same one. Must outlive the scenes that its RTCGeometry is in.
class Geometry {
  public:
    Geometry(RTCDevice device, const Tree& tree, const PhasetreeGeometryOptions& options = default_options())
        : reference_(make(device, tree, options)) {}

    /// With cells that write_cells() of a geometry of the same tree and options has written.
    static Geometry from_cells(RTCDevice device, const Tree& tree, const std::string& path,
                               const PhasetreeGeometryOptions& options = default_options()) {
        PhasetreeGeometry geometry = nullptr;
        check(phasetreeNewGeometryFromCells(PHASETREE_API_VERSION, device, tree.get(), &options, path.c_str(),
                                            &geometry));
        return Geometry(geometry);
    }
    void write_cells(const std::string& path) const { check(phasetreeWriteGeometryCells(get(), path.c_str())); }

    /// The RTCGeometry: uncommitted, the handle's own.
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
    void set_phase_user_data(unsigned phase, const PhaseUserData& mine) {
        check(phasetreeSetGeometryPhaseUserData(get(), phase, mine.integer, mine.pointer));
    }
    PhaseUserData phase_user_data(unsigned phase) const {
        PhaseUserData mine;
        check(phasetreeGetGeometryPhaseUserData(get(), phase, &mine.integer, &mine.pointer));
        return mine;
    }
    /// The interfaces as triangles.
    Mesh mesh(const PhasetreeMeshOptions& options = default_mesh_options()) const {
        struct Copy {
            Mesh mesh;
            std::exception_ptr failed;  // nothing may be thrown through the library
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
                          m->passedOver};
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
    /// A hit's place, or a point of geometry space, in the tree's own space.
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
    /// Of many points, at one time; with the radii that are empty if they are wanted.
    std::vector<unsigned> phases(const std::vector<std::array<float, 3>>& points, float time = 0,
                                 std::vector<float>* empty_radii = nullptr) const {
        std::vector<unsigned> all(points.size());
        if (empty_radii) empty_radii->resize(points.size());
        const PhasetreePoints p = listed(points, time);
        check(phasetreeGetPhaseN(get(), &p, all.data(), empty_radii ? empty_radii->data() : nullptr));
        return all;
    }
    /// Φ of the phases 0 … phase_count − 1 at each point, one point after another.
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
    /// Refers to both.
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
