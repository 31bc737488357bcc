// A scene after reading: everything that an image needs, as plain values.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "camera/moving_camera.hpp"
#include "film/film_settings.hpp"
#include "lights/lights.hpp"
#include "phasetree/io/tree.hpp"
#include "scene/length_unit.hpp"
#include "scene/mesh.hpp"
#include "scene/placed.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

// How the light of lamps is found. `all` combines shadow rays, directions sampled at surfaces and media, and, if the
// scene asks for caustics, photons, weighted by the power heuristic. The others use one of the first two alone, to
// measure its contribution. The result is still correct, except that shadow rays alone miss emitters outside all balls
// (scene/find_emissive_parts.hpp).
enum class Techniques { all, shadow_rays_alone, directions_alone };

struct RenderSettings {
    int samples = 64;  // per pixel
    float noise = 0;   // the error at which pixels stop early (render/noise_limit.hpp); 0 to disable
    Techniques techniques = Techniques::all;
    std::uint32_t seed = 0;
    // The maximum number of surfaces that a path meets, including those between phases of equal refractive index, and
    // of scattering points in media. Longer paths are cut off, and their light is lost. Where light is absorbed,
    // Russian roulette ends paths long before this. In lossless glass, a few paths in a million meet thousands of
    // surfaces, and cutting them off would lose light.
    int max_depth = 1 << 16;
    bool spectral = false;    // whether paths carry wavelengths instead of colours (spectrum/wavelengths.hpp)
    bool guiding = false;     // whether paths learn where light comes from (guiding/guide.hpp)
    bool caustics = false;    // whether photons are traced for caustics (caustics/caustics.hpp)
    float photons = 1;        // per pass, per pixel of the whole picture
    float photon_radius = 2;  // gathering radius in the first pass, in pixels
    float exposure_ev = 0.0f;
    std::optional<std::string> view;  // of the display transform
    glm::vec2 shutter{0.0f};          // opening and closing, in seconds relative to the time of the scene
};

// The objects of a scene, without materials, lights and surroundings.
struct SceneModel {
    PhaseNames phases;
    Phased object;                   // of a scene with one tree; otherwise empty
    PlacedObjects placed;            // of a scene with several objects; otherwise empty
    PhaseSet opaque;                 // the phases that light does not travel in; phases without a material are clear
    std::optional<LengthUnit> unit;  // of its lengths, if the file declares one
    std::vector<std::optional<double>> densities;  // by phase, in kg/m³; [0] is the vacuum's, which has none
};

struct Scene {
    std::filesystem::path file;
    PhaseNames phases;
    Phased object;                    // of a scene with one tree; otherwise empty
    PlacedObjects placed;             // of a scene with several objects; otherwise empty
    std::vector<Material> materials;  // by phase; [0] is the vacuum
    std::optional<LengthUnit> unit;   // as in SceneModel
    std::vector<std::optional<double>> densities;
    std::vector<Mesh> meshes;
    std::vector<std::string> not_shown;  // sentences about contents of mesh files that the scene lacks
    Lights lights;
    AnyCameraParameters camera;                // at the opening of the shutter
    std::vector<CameraMoment> camera_moments;  // while the shutter is open; empty if the camera does not move
    FilmSettings film;
    RenderSettings settings;

    // Whether any phase or mesh emits light.
    bool is_emissive() const;
    // Whether anything moves while the shutter is open.
    bool moves() const;
};

// Reads a whole scene. Files that it names are relative to it. Throws SceneError with the location in the text.
// `places` receives the positions of the object's nodes in the text.
Scene read_scene(const Document& document, NodePlaces* places = nullptr);

// The names of objects and meshes, in the order of their numbers (Surface::object).
std::vector<std::string> object_names(const Scene& scene);

// Reads the model of a file that need not be a complete scene, and checks everything else in it, with the same errors
// in the same order as read_scene. A file with a camera needs a version and a material for each phase, as in
// read_scene. A file without a camera needs neither: the value of a phase may then be any JSON value. It is read as a
// material if it is a JSON object with more than parameters such as "density". Does not check whether the object can be
// traced, seen and lit. Throws SceneError.
SceneModel read_scene_without_camera(const Document& document);

// As above, but does not open the files of lights, meshes, textures and voxels (Document::without_assets).
SceneModel read_scene_model(const Document& document);

// The phases that light does not travel in.
PhaseSet opaque_phases(const std::vector<Material>& materials);

}  // namespace phasetree::tracer
