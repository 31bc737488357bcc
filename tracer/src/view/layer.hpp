// Displays the film's planes on the page. A layer is a named group of channels of an EXR file, such as "depth" or
// "light_sun".
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "film/planes.hpp"
#include "output/display.hpp"

namespace phasetree::tracer::view {

struct FilmLayer {
    std::string name;
    std::size_t plane = 0;  ///< index in the order of Planes
};

/// All layers besides the picture that a film can have, given the names of its scene. Only the first layer of a
/// Cryptomatte plane is listed. It holds what covers most of a pixel.
std::vector<FilmLayer> layers_of_film(const SceneNames& scene_names);

/// The appearance of a layer of the image, in [0, 1]. Colours are displayed like the picture. Normals are mapped from
/// [−1, 1] to [0, 1], and positions so that the bounding box of the ball around `centre` becomes [0, 1]³. IDs (of
/// phases, objects, instances and Cryptomatte) become distinct colours. Depths range from dark grey for the farthest to
/// white for the nearest. Everything else is grey, from 0 to the image's maximum. Where nothing is hit, or if the layer
/// does not exist, the result is black.
std::vector<glm::vec3> layer_on_display(const Image& image, const std::string& layer, const DisplayTransform& display,
                                        const glm::vec3& centre, float radius);

}  // namespace phasetree::tracer::view
