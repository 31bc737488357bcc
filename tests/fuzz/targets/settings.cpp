// Whole scene files, as `phasetree render` reads them: materials, textures, lights, meshes, camera and settings; what
// becomes of them for a few directions; and, of a small tree, a few paths.
#include <cmath>

#include "fuzz/target.hpp"
#include "integrator/path.hpp"
#include "media/medium.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/program/program.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"
#include "shading/interface.hpp"
#include "source_directory.hpp"

namespace phasetree::fuzz {

namespace {

constexpr std::size_t most_instructions_traced = 40;

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void shine(const tracer::Lights& lights, const glm::vec3& p) {
    for (const glm::vec2 u : {glm::vec2(0.1f, 0.9f), glm::vec2(0.5f), glm::vec2(0.9999999f, 0)}) {
        const auto sample = lights.sample(p, u);
        if (!sample) continue;
        promised(std::abs(glm::length(sample->wi) - 1) < 1e-3f, "a sampled direction has unit length");
        promised(sample->pdf >= 0, "a density is not negative");
        (void)lights.pdf(p, sample->wi);
    }
    (void)lights.seen(p, {0, 0, 1}, INFINITY, true);
    (void)lights.towards_brightest(p, {0, 0, 1});
}

void scatter(const tracer::Scene& scene) {
    tracer::SharedSurfaces shared;
    const tracer::InterfaceTable table(scene.materials, shared);
    const std::size_t count = std::min<std::size_t>(scene.materials.size(), 4);
    const glm::vec3 wo = glm::normalize(glm::vec3(0.3f, 0.4f, 0.5f));
    for (std::size_t from = 0; from < count; ++from)
        for (std::size_t to = 0; to < count; ++to) {
            const tracer::Bsdf bsdf = table.between(from, to).at(glm::vec3(0.1f, 0.2f, 0.3f));
            for (const float u : {0.0f, 0.4f, 0.9999999f}) {
                const auto sample = bsdf.sample(wo, u, {u, 0.3f});
                if (!sample) continue;
                (void)bsdf.evaluate(wo, sample->wi);
                (void)bsdf.pdf(wo, sample->wi);
            }
        }
}

void scatter_in_media(const tracer::Scene& scene) {
    for (const tracer::Material& material : scene.materials) {
        const auto* const clear = std::get_if<tracer::Clear>(&material);
        const tracer::PhaseFunction* const phase = clear ? tracer::phase_function(clear->interior) : nullptr;
        if (!phase) continue;
        promised(std::abs(phase->mean_cosine()) < 1, "a mean cosine is between -1 and 1");
        for (const float u : {0.0f, 0.4f, 0.9999999f}) {
            const glm::vec3 direction = phase->sample({u, 0.3f});
            promised(std::abs(glm::length(direction) - 1) < 1e-3f, "a sampled direction has unit length");
            const float pdf = phase->evaluate(direction.z);
            promised(std::isfinite(pdf) && pdf > 0, "what is sampled has a density");
        }
    }
}

void render_little(tracer::Scene& scene) {
    int questions = 0;
    const auto is_enough = [&] { return ++questions > 500; };
    scene.film.width = std::min(scene.film.width, 3);
    scene.film.height = std::min(scene.film.height, 2);
    scene.settings.samples = 1;
    scene.settings.max_depth = std::min(scene.settings.max_depth, 12);
    try {
        const tracer::World world(scene, {.quality = BuildQuality::low, .cancelled = is_enough});
        tracer::RenderJob job;
        job.pixels = scene.film.whole();
        job.threads = 1;
        (void)render(world, scene, job);
    } catch (const BuildCancelled&) {
    }
}

}  // namespace

void run_settings(Bytes input) {
    try {
        tracer::Scene scene = tracer::read_scene(
            Document::from_text(std::string(text_of(input)), source_directory() + "/tests/fuzz/assets/input.json"));
        const FlushSubnormals flush;
        const tracer::Camera camera(scene.camera, scene.film.resolution());
        const tracer::CameraRay ray = camera.generate({0.5, 0.5}, {0.25f, 0.75f});
        promised(!is_finite(ray.direction) || std::abs(glm::length(ray.direction) - 1) < 1e-3f,
                 "a camera ray's direction has unit length");
        shine(scene.lights, {0, 0, 0});
        shine(scene.lights, look_at_of(scene.camera));
        scatter(scene);
        scatter_in_media(scene);
        std::size_t corners = 0;
        for (const tracer::Mesh& mesh : scene.meshes) corners += mesh.vertices.size();
        if (corners < 1000 && record(scene.object, 20'000).instructions.size() <= most_instructions_traced)
            render_little(scene);
    } catch (const SceneError&) {
    } catch (const ModelError&) {
    }
}

}  // namespace phasetree::fuzz
