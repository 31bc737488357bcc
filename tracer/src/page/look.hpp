// A phase's appearance in a few numbers, for real-time pages and other programs.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>

#include "phasetree/math/bounds.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

// Textures are represented by their mean.
struct Look {
    enum Kind { clear, diffuse, metal, coated, glowing };

    std::string name;
    Kind kind = clear;
    glm::vec3 color{1};       // base colour; for metal, the reflectance at normal incidence; for emitters, their light
    glm::vec3 absorption{0};  // extinction of clear phases, including scattering, per unit of length
    float ior = 1;
};

/// The look of a phase's material in an object with these bounds.
Look look_of(const std::string& name, const Material&, const Bounds&);

/// A colour swatch as sRGB codes from 0 to 255. For a clear phase, the colour of light after 0.3 units of length.
std::array<int, 3> shown_color(const Look&);

}  // namespace phasetree::tracer
