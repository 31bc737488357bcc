// What a ray meets. An answer holds only what its case has: nothing has to be recognised by a value that stands for
// something else.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <variant>

#include "shading/frame.hpp"
#include "shading/interface.hpp"
#include "world/ray.hpp"

namespace phasetree::tracer {

/// The ray left the scene without meeting anything.
struct Escaped {};

/// The ray met a surface: an interface between two phases of the object, or a mesh.
struct Surface {
    /// Where a ray starts that leaves the surface to one of its sides, and the phase that it is in then. The two
    /// origins of an interface are the ends of the bracket in which the phase changes, so each lies in its phase.
    struct Side {
        glm::vec3 origin;
        Phase phase;
        RayObjects in{};
        std::optional<StartInCopy> start{};
    };

    float distance;  ///< from the ray's origin
    /// The shading normal, by which light is scattered: of unit length, on the side the ray came from. It is that of
    /// the surface but for bumps, maps of normals and the smooth normals of meshes.
    glm::vec3 normal;
    glm::vec3 geometric_normal;    ///< the surface's own, of unit length, on the side the ray came from
    Side near_side;                ///< the one the ray came from; its phase is clear
    std::optional<Side> far_side;  ///< the other; none where light does not travel there: opaque phases and meshes
    std::reference_wrapper<const Interface> optics;  ///< seen from the near side
    StartHint hint;                                  ///< for a ray from either side
    std::uint32_t object;                            ///< the objects of phases come first, then the meshes
    std::optional<Phase> entered;                    ///< the phase behind, clear or opaque; none behind a mesh
    TexturePoint place;                              ///< in the space of what was met
    std::optional<glm::vec3> along_grain{};          ///< in the scene's space, if the surface has a grain (grain.hpp)
    /// The part of the rays that are stopped there: less than 1 of a mesh that lets light through
    /// (shading/opacity.hpp).
    float opacity = 1.0f;
    /// Whether something other than a smooth surface is there: of a mixture, also what was not chosen for this ray.
    bool is_partly_rough = false;

    /// The space of its BSDF: local z is the shading normal, and x is along the grain, if it has any.
    Frame frame() const { return along_grain ? Frame(normal, *along_grain) : Frame(normal); }

    /// For light of these wavelengths, or for red, green and blue; it must not outlive the wavelengths.
    Bsdf bsdf(const Wavelengths* wavelengths = nullptr) const { return optics.get().at(place, wavelengths); }
    /// What it sends by itself to the near side.
    std::optional<Interface::Emitted> emitted(const Wavelengths* wavelengths = nullptr) const {
        return optics.get().emitted(place, wavelengths);
    }
    /// A ray that leaves the surface to the side from which it was met.
    Ray reflected(const glm::vec3& direction) const { return leaving(near_side, direction); }
    /// A ray that leaves the surface to its far side. Throws std::bad_optional_access if light does not travel there.
    Ray transmitted(const glm::vec3& direction) const { return leaving(far_side.value(), direction); }

  private:
    Ray leaving(const Side& side, const glm::vec3& direction) const {
        return {side.origin, direction, side.phase, hint, side.in, side.start};
    }
};

using Hit = std::variant<Escaped, Surface>;

/// A path was scattered on its way through a phase, before it met anything.
struct MediumPoint {
    glm::vec3 position;
    Phase phase;
    std::reference_wrapper<const HenyeyGreenstein> phase_function;
    RayObjects in{};

    /// A ray on which it goes on.
    Ray leaving(const glm::vec3& direction) const { return {position, direction, phase, {}, in}; }
};

/// The ray met something that light does not pass: a mesh or an opaque phase.
struct Blocked {
    float distance;
    std::optional<Surface> glowing{};  ///< if it sends light by itself
};

/// What stands between a point and a light: nothing, something opaque, or an interface of two clear phases, beyond
/// which the light may still be seen (path.hpp). Such a surface always has a far side.
using Visibility = std::variant<Escaped, Blocked, Surface>;

}  // namespace phasetree::tracer
