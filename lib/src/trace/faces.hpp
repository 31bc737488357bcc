#pragma once

#include <optional>
#include <span>

#include "kernel/faces.hpp"
#include "phasetree/model/crossing.hpp"

/// The search along a ray in a cell whose program is a single mesh. The label changes exactly at the mesh's faces, so
/// the ray is intersected with these and no distance is evaluated.
namespace phasetree::trace {

/// The faces that touch a cell's box, with corners that are counterclockwise seen from the phase `first`. `other` is
/// the phase behind them.
struct FacesOfCell {
    std::span<const kernel::FaceBatch> faces;
    const Bounds& box;
    Phase first, other;
};

/// The arguments of a search: see InterfaceCells::first_crossing().
struct FaceVisit {
    const TracedRay& ray;
    float t_min, t_max;
    float resolution;
    std::optional<Phase> carried;
};

/// What the faces alone determine about the first change of phase along a ray.
enum class FaceAnswer {
    none,
    crossing,
    none_if_in_phase,  ///< none if the ray really starts in the phase that it carries, which the faces cannot decide
    unclear            ///< rounding errors matter, so the cell's program must decide
};

/// Finds the first change of phase in a cell.
///
/// Faces divide the line into parts that are alternately in one phase and in the other. `leaving` are the crossings out
/// of the carried phase, `entering` those into it. In order along the ray, from its start in the box:
///
///   * If an entering crossing comes first, the ray is not in the phase that it carries. If the ray enters the box from
///     outside and no face is within four resolutions of the entry point, the change of phase is reported there, with
///     zero length; otherwise the answer is `unclear`. For a ray that starts in the box, an entering crossing within
///     four resolutions of the start is skipped, as in the kernel, because rounding has moved the start across the
///     face; any other is `unclear`.
///   * If a leaving crossing comes first, it is the change of phase, unless an entering crossing follows within three
///     resolutions. The change may then be undone, or the ray may be on an edge, so the answer is `unclear`.
///   * If there is none, the phase does not change. For a ray that starts in the box, the last crossing behind the
///     start must be one that enters; otherwise the ray may not be in its phase.
///
/// The bracket is the crossing and half a resolution to either side. Its ends are on the two sides of the face, as
/// computed in doubles from their coordinates. If the ray grazes the face, rounding may put them on the wrong side;
/// they are then moved by up to three units in the last place.
FaceAnswer first_crossing(const FacesOfCell&, const FaceVisit&, Crossing&);

/// The normal of a crossing, from `from` into `to`; nullopt if no face changes the phase there.
std::optional<glm::vec3> normal_of_face(const FacesOfCell&, const Crossing&, const glm::vec3& direction,
                                        float resolution);

}  // namespace phasetree::trace
