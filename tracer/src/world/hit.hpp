// The result of tracing a ray. Each case has only the members that it needs, without sentinel values.
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
    /// The origin and phase of a ray that leaves the surface on one of its sides. The two origins of an interface are
    /// the ends of the bracket in which the phase changes, so each lies in its phase.
    struct Side {
        glm::vec3 origin;
        Phase phase;
        RayObjects in{};
        std::optional<StartInCopy> start{};
    };

    float distance;  ///< from the ray's origin
    /// The shading normal, for scattering: of unit length, on the side from which the ray came. It differs from that of
    /// the surface by bumps, normal maps and the smooth normals of meshes.
    glm::vec3 normal;
    glm::vec3 geometric_normal;    ///< the surface's own, unit length, on the side from which the ray came
    Side near_side;                ///< side from which the ray came; its phase is clear
    std::optional<Side> far_side;  ///< the other side; nullopt if opaque: opaque phases, and meshes that are not thin
    std::reference_wrapper<const Interface> optics;  ///< seen from the near side
    StartHint hint;                                  ///< for a ray from either side
    std::uint32_t object;                            ///< the objects of phases first, then the meshes
    std::optional<Phase> entered;                    ///< phase behind, clear or opaque; nullopt for a mesh
    TexturePoint place;                              ///< in the space of the object or mesh
    std::optional<glm::vec3> along_grain{};          ///< in scene space, if the surface has a grain (grain.hpp)
    /// The share of rays that are stopped there: less than 1 for a mesh that is partly transparent
    /// (shading/opacity.hpp).
    float opacity = 1.0f;
    /// Whether anything other than a smooth surface is there, including the material of a mixture that was not chosen
    /// for this ray.
    bool is_partly_rough = false;

    /// Whether shadow rays and photons may continue on the far side: not behind a thin diffuse mesh, which scatters all
    /// light.
    bool is_transparent() const { return far_side && !optics.get().is_thin_diffuse(); }

    /// The local frame of its BSDF: z is the shading normal, and x is along the grain, if any.
    Frame frame() const { return along_grain ? Frame(normal, *along_grain) : Frame(normal); }

    /// For light of these wavelengths, or for red, green and blue. The BSDF must not outlive the wavelengths.
    Bsdf bsdf(const Wavelengths* wavelengths = nullptr) const { return optics.get().at(place, wavelengths); }
    /// Its emission to the near side.
    std::optional<Interface::Emitted> emitted(const Wavelengths* wavelengths = nullptr) const {
        return optics.get().emitted(place, wavelengths);
    }
    /// A ray that leaves the surface on the side from which it was met.
    Ray reflected(const glm::vec3& direction) const { return leaving(near_side, direction); }
    /// A ray that leaves the surface on its far side. Throws std::bad_optional_access if that is opaque.
    Ray transmitted(const glm::vec3& direction) const { return leaving(far_side.value(), direction); }

  private:
    Ray leaving(const Side& side, const glm::vec3& direction) const {
        return {side.origin, direction, side.phase, hint, side.in, side.start};
    }
};

using Hit = std::variant<Escaped, Surface>;

/// A path was scattered in a phase before it met a surface.
struct MediumPoint {
    glm::vec3 position;
    Phase phase;
    std::reference_wrapper<const PhaseFunction> phase_function;
    RayObjects in{};

    /// A ray that continues from there.
    Ray leaving(const glm::vec3& direction) const { return {position, direction, phase, {}, in}; }
};

/// The ray met something opaque: a mesh or an opaque phase.
struct Blocked {
    float distance;
    std::optional<Surface> emissive{};  ///< set if it is emissive
};

/// The occluder between a point and a light: none, something opaque, or an interface of two clear phases or a thin
/// pane, beyond which the light may still be visible (path.hpp). Such a surface is always transparent.
using Visibility = std::variant<Escaped, Blocked, Surface>;

}  // namespace phasetree::tracer
