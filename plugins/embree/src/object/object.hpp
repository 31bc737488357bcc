#pragma once

#include <memory>
#include <optional>

#include "phasetree/embree.hpp"

namespace phasetree::embree {

/// A ray within the object's own space: direction of unit length, distances from the origin.
struct ObjectRay {
    glm::vec3 origin{0}, direction{0};
    float near = 0, far = 0;
};

/// Embree could not build: which error, or none if it does not tell.
class EmbreeError : public std::runtime_error {
  public:
    EmbreeError(RTCError code, const char* what);
    RTCError code() const { return code_; }

  private:
    RTCError code_;
};

/// An object's cells in an Embree scene of their own: rays find their first crossing, whole and in order. Immutable;
/// any thread may trace.
///
/// An application's geometry could have the cells for primitives itself, and the path tracer's has (TreeGeometry). But
/// Embree asks cells in any order and each knows only its own span of the ray. That tells which crossing is the first;
/// it cannot tell a filter function each crossing once, because cells reach into each other, nor which phase a ray is
/// in that a filter has let through. A scene within makes both simple, and costs a tenth or so (README.md).
class Object {
  public:
    /// Throws ModelError, BuildCancelled, EmbreeError. Clears the thread's error code of the device.
    Object(RTCDevice device, std::shared_ptr<const InterfaceCells> cells);
    ~Object();
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    const InterfaceCells& cells() const { return tree_.object(); }

    struct Found {
        unsigned cell = 0;
        Crossing crossing;
    };
    std::optional<Found> first_crossing(const ObjectRay&, std::optional<Phase> carried) const;
    /// Whether there is any.
    bool any_crossing(const ObjectRay&, std::optional<Phase> carried) const;

    /// The scene of the cells, for queries of other kinds.
    RTCScene scene() const { return scene_; }

  private:
    TreeGeometry tree_;
    RTCScene scene_ = nullptr;
};

/// Goes from crossing to crossing along a ray. Each starts where the last one ended, at its very point and in its
/// phase.
class Walk {
  public:
    Walk(const Object& object, const ObjectRay& ray, std::optional<Phase> carried)
        : object_(object), rest_(ray), carried_(carried), far_(static_cast<double>(ray.far)) {}

    /// The next crossing, its distances from the first ray's origin; none, once there is none.
    std::optional<Object::Found> next();

  private:
    const Object& object_;
    ObjectRay rest_;
    std::optional<Phase> carried_;
    double far_;
    double base_ = 0;    ///< distance of rest_'s origin from the ray's
    double anchor_ = 0;  ///< of the place since which the walk has not come on
    int stuck_ = 0;      ///< steps since then
};

}  // namespace phasetree::embree
