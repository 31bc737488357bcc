// A self-contained page that shows an object in a browser, without a network: the object's shader, its numbers, and
// camera controls.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "page/look.hpp"
#include "phasetree/glsl/shader.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

struct PageView {
    glm::vec3 position, look_at;
    float fov = 40;  // vertical, in degrees
};

PageView view_of(const AnyCameraParameters&);

// Returns the text of the page. `floor` is the height of the ground.
std::string make_page(const std::string& title, const GlslShader&, const Bounds&, const std::vector<Look>&,
                      const PageView&, float floor);

}  // namespace phasetree::tracer
