// One file that shows an object in a browser, from disk and without a net: the object's shader, its numbers and what
// moves the camera.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "phasetree/glsl/shader.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// How a phase looks in real time. Textures count by their mean.
struct Look {
    enum Kind { clear, diffuse, metal, coated, glowing };

    std::string name;
    Kind kind = clear;
    glm::vec3 color{1};       // of the base; of metal what it reflects head-on; of what glows its light
    glm::vec3 absorption{0};  // of what is clear, per unit of length
    float ior = 1;
};

struct PageView {
    glm::vec3 position, look_at;
    float fov = 40;  // vertical, in degrees
};

Look look_of(const std::string& name, const Material&, const Bounds&);
PageView view_of(const AnyCameraParameters&);

// The page's text. `floor` is the height of the ground.
std::string make_page(const std::string& title, const GlslShader&, const Bounds&, const std::vector<Look>&,
                      const PageView&, float floor);

}  // namespace phasetree::tracer
