// A scene file, read: everything an image needs, as plain values.
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
#include "scene/mesh.hpp"
#include "scene/placed.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

// How the light of lamps is found: by shadow rays, by directions that surfaces and media sample, and by photons if the
// scene asks for caustics, weighted by the power heuristic; or by one of the first two alone, which shows in a
// measurement what each is good for. It is as right, but that shadow rays alone miss what glows outside of all balls
// (scene/glowing.hpp).
enum class Techniques { all, shadow_rays_alone, directions_alone };

struct RenderSettings {
    int samples = 64;  // per pixel
    float noise = 0;   // the error at which pixels stop before that (render/noise_limit.hpp); 0 if none does
    Techniques techniques = Techniques::all;
    std::uint32_t seed = 0;
    // The most surfaces that a path meets, those between equal indices included, and points in media that scatter it;
    // what it would bring beyond is lost.
    // Roulette ends paths long before where light is absorbed. In lossless glass a few in a million meet thousands of
    // surfaces, and to cut those off would lose light.
    int max_depth = 1 << 16;
    bool spectral = false;    // whether paths carry wavelengths instead of colours (spectrum/wavelengths.hpp)
    bool guiding = false;     // whether paths learn where light comes from (guiding/guide.hpp)
    bool caustics = false;    // whether photons look for caustics (caustics/caustics.hpp)
    float photons = 1;        // of each pass, per pixel of the whole picture
    float photon_radius = 2;  // in which they are gathered in the first pass, in pixels
    float exposure_ev = 0.0f;
    std::optional<std::string> view;  // of the display transform
    glm::vec2 shutter{0.0f};          // when it opens and closes, in seconds from the time at which the scene is read
};

// The objects of a scene, without materials, lights and surroundings.
struct SceneModel {
    PhaseNames phases;
    Phased object;         // of a scene of one tree; empty otherwise
    PlacedObjects placed;  // of a scene of several objects; empty otherwise
    PhaseSet opaque;       // the phases that light does not travel in; phases without a material are clear
};

struct Scene {
    std::filesystem::path file;
    PhaseNames phases;
    Phased object;                    // of a scene of one tree; empty otherwise
    PlacedObjects placed;             // of a scene of several objects; empty otherwise
    std::vector<Material> materials;  // by phase; [0] is the vacuum
    std::vector<Mesh> meshes;
    std::vector<std::string> not_shown;  // sentences about what is in the files of meshes and not in the scene
    Lights lights;
    AnyCameraParameters camera;                // as the shutter opens
    std::vector<CameraMoment> camera_moments;  // while it is open; none of a camera that stands still
    FilmSettings film;
    RenderSettings settings;

    // Whether any phase of the objects, or any mesh, shines by itself.
    bool shines() const;
    // Whether anything moves while the shutter is open.
    bool moves() const { return !camera_moments.empty() || !placed.moving.empty(); }
};

// Reads a whole scene. Files it names are relative to it. Throws SceneError with the place in the text.
// `places` is told where the object's nodes stand.
Scene read_scene(const Document& document, NodePlaces* places = nullptr);

// What objects and meshes are called, in the order of their numbers (Surface::object).
std::vector<std::string> object_names(const Scene& scene);

// Reads the model of a file that need not be a whole scene, and checks everything else in the file, with the same
// errors in the same order as read_scene. A file with a camera needs a version and a material for each phase, as
// read_scene demands. A file without one needs neither: its phases may have anything that is no object instead of a
// material. Whether the object can be traced, seen and lit is not checked. Throws SceneError.
SceneModel read_scene_without_camera(const Document& document);

// The same, without opening the files of lights, meshes, textures and voxels (Document::without_assets).
SceneModel read_scene_model(const Document& document);

// The phases that light does not travel in.
PhaseSet opaque_phases(const std::vector<Material>& materials);

}  // namespace phasetree::tracer
