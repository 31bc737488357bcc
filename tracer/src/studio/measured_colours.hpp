// The colours of measured substances, which the page offers to choose from.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace phasetree::tracer::studio {

struct MeasuredColour {
    std::string name;             ///< as in scene files: "gold", "whole_milk"
    std::string group;            ///< "metals" or "materials"
    glm::vec3 reflectance{0.0f};  ///< linear Rec.709
};

/// For metals, the reflectance at normal incidence; for scattering media, the diffuse reflectance of a thick layer.
std::vector<MeasuredColour> measured_colours();

}  // namespace phasetree::tracer::studio
