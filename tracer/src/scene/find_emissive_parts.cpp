#include "scene/find_emissive_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "scene/emissive_parts.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

namespace {

// If all objects together, emitting or not, have more copies than this, no object has balls: searching the copies for
// emitters would take too long.
constexpr std::uint64_t most_copies_searched = 10'000'000;
// If there are more emitting copies than this, none of them has balls.
constexpr std::size_t max_emissive_copies = 10'000;
// While there are more balls than this, the object with the most is reduced to one ball per copy.
constexpr std::size_t most_parts = 50'000;

// At the opening of the shutter, halfway, and at its closing.
using Places = std::array<Transform, 3>;

// A ball that contains a moving ball at the three sampled moments, though not necessarily in between. Returns nullopt
// if it exceeds the range of floats or has no radius.
std::optional<BoundingSphere> around(const BoundingSphere& ball, const Places& places) {
    Bounds centres;
    double stretch = 0;
    for (const Transform& place : places) {
        const glm::vec3 centre(place(glm::dvec3(ball.centre)));
        centres = unite(centres, {centre, centre});
        stretch = std::max(stretch, place.stretch());
    }
    const BoundingSphere placed{centres.centre(),
                                0.5f * centres.diagonal() + static_cast<float>(stretch) * ball.radius};
    if (!centres.finite() || !std::isfinite(placed.radius) || !(placed.radius > 0.0f)) return std::nullopt;
    return placed;
}

void add(std::span<const EmissiveBall> parts, const Places& places, Lights& lights) {
    for (const EmissiveBall& part : parts)
        if (const auto ball = around(part.ball, places)) lights.add(EmissivePart(*ball, part.luminance, part.of));
}

// A single ball around all parts.
EmissiveBall merged(std::span<const EmissiveBall> parts) {
    Bounds box;
    float sum = 0;
    auto of = EmissivePart::Of::medium;
    for (const EmissiveBall& part : parts) {
        box = unite(box, {part.ball.centre - part.ball.radius, part.ball.centre + part.ball.radius});
        sum += part.luminance;
        if (part.of == EmissivePart::Of::surface) of = part.of;
    }
    return part_in(box, sum / static_cast<float>(parts.size()), of);
}

// The emitting parts of an object, and the transforms and numbers of its copies.
struct EmissiveObject {
    std::vector<EmissiveBall> parts;
    std::map<std::uint32_t, Places> copies;

    std::size_t parts_in_all() const { return parts.size() * copies.size(); }
};

std::vector<EmissiveObject> emissive_objects(const Scene& scene) {
    const PlacedObjects& placed = scene.placed;
    std::vector<EmissiveObject> objects(placed.objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i) try {
            objects[i].parts = parts_of_phases(placed.objects[i].tree, scene.materials);
        } catch (const ModelError&) {
            // The object cannot be traced; building the World reports the error.
        }
    std::size_t emissive = 0;
    for (std::size_t moment = 0; moment < Places().size(); ++moment)
        placed.each_copy(
            [&](std::uint32_t copy, const PlacedObject& object, const Transform& to_scene) {
                EmissiveObject& of = objects[static_cast<std::size_t>(&object - placed.objects.data())];
                if (of.parts.empty()) return true;
                of.copies[copy][moment] = to_scene;
                if (moment == 0) ++emissive;
                return emissive <= max_emissive_copies;
            },
            0.5 * static_cast<double>(moment));
    if (emissive > max_emissive_copies) return {};
    return objects;
}

Places places_of(const Mesh& mesh) {
    if (!mesh.motion) return Places();
    return {mesh.motion->at(0), mesh.motion->at(0.5), mesh.motion->at(1)};
}

void add_objects(Scene& scene) {
    if (scene.placed.copies() > most_copies_searched) return;
    std::vector<EmissiveObject> objects = emissive_objects(scene);
    const auto in_all = [&] {
        std::size_t sum = 0;
        for (const EmissiveObject& object : objects) sum += object.parts_in_all();
        return sum;
    };
    while (in_all() > most_parts) {
        EmissiveObject& most = *std::ranges::max_element(objects, {}, &EmissiveObject::parts_in_all);
        most.parts = {merged(most.parts)};
    }
    for (const EmissiveObject& object : objects)
        for (const auto& [copy, places] : object.copies) add(object.parts, places, scene.lights);
}

}  // namespace

void find_emissive_parts(Scene& scene) {
    const auto join_group = [&](Material& material) {
        if (Glowing* glowing = emission_of(material))
            glowing->group_number = static_cast<std::uint32_t>(scene.lights.group_of(glowing->group));
    };
    for (Material& material : scene.materials) join_group(material);
    for (Mesh& mesh : scene.meshes) join_group(mesh.material);
    if (!scene.is_emissive()) return;
    if (scene.object)
        add(parts_of_phases(scene.object, scene.materials), Places(), scene.lights);
    else
        add_objects(scene);
    for (const Mesh& mesh : scene.meshes)
        if (glows(mesh.material)) add(parts_of_mesh(mesh), places_of(mesh), scene.lights);
}

}  // namespace phasetree::tracer
