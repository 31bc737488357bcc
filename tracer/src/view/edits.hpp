// Changes that the page makes to a viewed scene, without changing its file: hidden phases, phases with other materials,
// and a cutting plane. The picture is the same as if the file contained them.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace phasetree::tracer::view {

/// Changes to a phase's material. Members without a value change nothing, and neither do those that the material lacks.
struct Look {
    bool is_clear = false;  ///< make the phase clear, regardless of its material, so that light travels inside
    /// The reflectance; for a clear phase, the fraction of white light left after half the diagonal of the object's
    /// box.
    std::optional<glm::vec3> color{};
    std::optional<float> ior{}, roughness{};
};

/// Cuts away what lies on the side that the normal points to: the node `intersect_shape` with the node `plane`.
struct CutPlane {
    glm::vec3 normal{1, 0, 0};  ///< any length except zero
    float offset = 0;           ///< distance from the origin along the normal
};

/// Names of phases that the scene lacks are ignored, because the file may be saved with other phases.
struct Edits {
    std::vector<std::string> hidden;  ///< replaced by vacuum, as by the node `remove`
    std::map<std::string, Look> looks;
    std::optional<CutPlane> cut;
};

/// Throws ModelError if the plane's normal is zero.
Scene edited(const Scene& scene, const Edits& edits);

/// The properties of a material that a Look can change.
struct Optics {
    std::string kind;                             ///< the kind's name in scene files
    bool has_color = true, has_roughness = true;  ///< also true if the value varies from place to place
    std::optional<glm::vec3> color{};
    std::optional<float> ior{};  ///< empty for materials without one
    std::optional<float> roughness{};
};

/// For a clear phase, the colour is defined as in Look; `depth` is half the diagonal of the object's box. Properties
/// that vary from place to place have no value.
Optics optics_of(const Material& material, float depth);

/// The properties after applying a look.
Optics looking(const Optics& optics, const Look& look);

/// Half the diagonal of the object's box, or 1 for an unbounded object.
float half_diagonal(const Phased& object);

}  // namespace phasetree::tracer::view
