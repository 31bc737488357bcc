// What the page shows at one moment: a picture and information about it. Immutable once published, so any number of
// threads may hold it.
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
    std::uint64_t number = 0;  ///< increases from picture to picture
    Image linear;
    std::vector<std::uint8_t> pixels;  ///< display values: red, green and blue, row by row
    int scale = 1;                     ///< pixels of the whole picture per side of one of these pixels
    int samples = 0;                   ///< per pixel
    AnyCameraParameters camera;
    std::string layer;                          ///< the layer shown; empty for the picture itself
    glm::vec3 centre{0.0f};                     ///< of the object, for showing the layer
    float radius = 1;                           ///< of a ball around the object
    std::shared_ptr<const ViewedScene> viewed;  ///< the scene that was rendered
    std::shared_ptr<const Prepared> prepared;   ///< the same scene, prepared for rays
    float exposure_ev = 0;                      ///< of the display transform
};

struct ShownPhase {
    std::string name;
    bool is_hidden = false;  ///< as requested, even before there is a picture of it
    Optics optics;           ///< in the file
    Look look;               ///< requested changes to it
};

struct Shown {
    std::uint64_t version = 0;  ///< increases whenever anything here changes
    std::shared_ptr<const Picture> picture;
    std::string doing;         ///< the current work, as a message for the user
    std::string error;         ///< as shown on a terminal; empty if there is none
    std::string warning;       ///< likewise
    std::string scene;         ///< name of the scene
    glm::ivec2 resolution{0};  ///< of the whole picture
    int samples = 0;           ///< final number per pixel
    std::vector<ShownPhase> phases;
    std::optional<CutPlane> cut;            ///< as requested
    std::string layer;                      ///< as requested; empty for the picture itself
    std::vector<FilmLayer> layers;          ///< the available layers
    NumberEdits numbers;                    ///< as requested, instead of those in the file
    std::vector<std::string> hidden_parts;  ///< as requested: pointers into the file
    /// The numbers in the file, and the version of the file (counted by its readings) that they come from.
    std::shared_ptr<const TextNumbers> numbers_of_file = std::make_shared<TextNumbers>();
    std::uint64_t numbers_version = 0;
    double seconds = 0;            ///< as requested: the time that is shown
    std::optional<TimeSpan> keys;  ///< the range from the scene's first key to its last
    std::string camera_text;       ///< as requested, as text for a scene file; empty until there is an object
    glm::vec3 centre{0.0f};        ///< of the object
    float radius = 1;              ///< of a ball around it
    float exposure_ev = 0;
    double seconds_to_picture = 0;  ///< from the last change to its first picture
};

}  // namespace phasetree::tracer::view
