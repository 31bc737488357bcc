// What a phase looks like to those who know no more of it than a few numbers: pages in real time, and other programs.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>

#include "phasetree/math/bounds.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

// Textures count by their mean.
struct Look {
    enum Kind { clear, diffuse, metal, coated, glowing };

    std::string name;
    Kind kind = clear;
    glm::vec3 color{1};       // of the base; of metal what it reflects head-on; of what glows its light
    glm::vec3 absorption{0};  // of what is clear, with what it scatters, per unit of length
    float ior = 1;
};

/// Of a phase's material in an object of these bounds.
Look look_of(const std::string& name, const Material&, const Bounds&);

/// The colour of a swatch of it, as sRGB codes from 0 to 255. A clear phase has the colour of light that has passed 0.3
/// units of length of it.
std::array<int, 3> shown_color(const Look&);

}  // namespace phasetree::tracer
