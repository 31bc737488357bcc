// What the page shows at a time: a picture and what is to be said of it. A value that is never changed, so that any
// number of threads may hold the last one.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "film/image.hpp"
#include "view/edits.hpp"
#include "view/layer.hpp"
#include "view/prepared.hpp"
#include "view/viewed_scene.hpp"

namespace phasetree::tracer::view {

struct Picture {
    std::uint64_t number = 0;  ///< grows from one to the next
    Image linear;
    std::vector<std::uint8_t> pixels;  ///< as the display shows them: red, green and blue, row by row
    int scale = 1;                     ///< of the whole picture's pixels along a side of one of these
    int samples = 0;                   ///< in each pixel
    AnyCameraParameters camera;
    std::string layer;                          ///< that is shown of it; empty for the picture itself
    glm::vec3 centre{0.0f};                     ///< of the object, for that,
    float radius = 1;                           ///< and of a ball around it
    std::shared_ptr<const ViewedScene> viewed;  ///< what it was taken of …
    std::shared_ptr<const Prepared> prepared;   ///< … ready for rays
    float exposure_ev = 0;                      ///< with which the display shows it
};

struct ShownPhase {
    std::string name;
    bool is_hidden = false;  ///< as it is wished, before there is a picture of that
    Optics optics;           ///< as the file says it
    Look look;               ///< what is wished to be changed of that
};

struct Shown {
    std::uint64_t version = 0;  ///< grows whenever anything here changes
    std::shared_ptr<const Picture> picture;
    std::string doing;         ///< what is worked on: a sentence for people
    std::string error;         ///< as a terminal shows it; empty if all is well
    std::string warning;       ///< likewise
    std::string scene;         ///< what it is called
    glm::ivec2 resolution{0};  ///< of the whole picture
    int samples = 0;           ///< that a pixel is to have in the end
    std::vector<ShownPhase> phases;
    std::optional<CutPlane> cut;    ///< likewise
    std::string layer;              ///< likewise; empty for the picture itself
    std::vector<FilmLayer> layers;  ///< that there are
    NumberEdits numbers;            ///< likewise, instead of those of the file
    /// Those of the file, and how often it has been read until they were there.
    std::shared_ptr<const TextNumbers> numbers_of_file = std::make_shared<TextNumbers>();
    std::uint64_t numbers_version = 0;
    double seconds = 0;            ///< likewise: the time of what is shown,
    std::optional<TimeSpan> keys;  ///< and from the scene's first key to its last
    std::string camera_text;       ///< likewise, as the scene's file would say it; empty until there is an object
    glm::vec3 centre{0.0f};        ///< of the object
    float radius = 1;              ///< of a ball around it
    float exposure_ev = 0;
    double seconds_to_picture = 0;  ///< from the last change to the first picture of it
};

}  // namespace phasetree::tracer::view
