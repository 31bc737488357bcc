// What the page changes of a scene that is viewed, and the file does not know: phases hidden, phases that look
// otherwise, and a plane that cuts the object open. The picture is then that of a scene whose file says the same.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace phasetree::tracer::view {

/// What is changed of a phase's material. What has no value stays, and what a material does not have is not changed.
struct Look {
    bool is_clear = false;  ///< made so, whatever it is: light travels inside
    /// The reflectance, or of a clear phase what is left of white light after half the diagonal of the object's box.
    std::optional<glm::vec3> color{};
    std::optional<float> ior{}, roughness{};
};

/// What lies on the side to which the normal points is cut away: the node `intersect_shape` with the node `plane`.
struct CutPlane {
    glm::vec3 normal{1, 0, 0};  ///< of any length but zero
    float offset = 0;           ///< from the origin along the normal
};

/// Names of phases that the scene does not have count for nothing: the file may be saved with others.
struct Edits {
    std::vector<std::string> hidden;  ///< vacuum takes their place, as by the node `remove`
    std::map<std::string, Look> looks;
    std::optional<CutPlane> cut;
};

/// Throws ModelError if the plane's normal has no direction.
Scene edited(const Scene& scene, const Edits& edits);

/// What a material has that a Look can change, as it is.
struct Optics {
    std::string kind;                             ///< as scene files name it
    bool has_color = true, has_roughness = true;  ///< also where these vary from place to place
    std::optional<glm::vec3> color{};
    std::optional<float> ior{};  ///< none of what has no index
    std::optional<float> roughness{};
};

/// Of a clear phase the colour is as in Look; `depth` is half the diagonal of the object's box. What varies from place
/// to place has no value.
Optics optics_of(const Material& material, float depth);

/// What becomes of them by a look.
Optics looking(const Optics& optics, const Look& look);

/// Half the diagonal of the object's box, or 1 where the object has no end.
float half_diagonal(const Phased& object);

}  // namespace phasetree::tracer::view
