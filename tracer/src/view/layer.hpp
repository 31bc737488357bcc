// The film's planes as the page shows them. A layer is what an EXR file has under one name: "depth", "light_sun".
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "film/planes.hpp"
#include "output/display.hpp"

namespace phasetree::tracer::view {

struct FilmLayer {
    std::string name;
    std::size_t plane = 0;  ///< in the order of Planes
};

/// All that a film of these subjects can have beside the picture. Of a Cryptomatte plane it is the first layer, which
/// has what covers most of a pixel.
std::vector<FilmLayer> layers_of_film(const PlaneSubjects& subjects);

/// What a layer of the image looks like, in [0, 1]. Colours are shown as the picture is. Normals are turned from [−1,
/// 1] into [0, 1], positions from the box of the ball around `centre`. Numbers of phases and objects, and
/// Cryptomatte's, become colours, one for each. Depths are grey from the farthest, which is dark, to the nearest, which
/// is white. All else is grey from 0 to the largest value of the image. Where there is nothing, or no such layer, all
/// is black.
std::vector<glm::vec3> layer_on_display(const Image& image, const std::string& layer, const DisplayTransform& display,
                                        const glm::vec3& centre, float radius);

}  // namespace phasetree::tracer::view
