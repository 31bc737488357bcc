#include "scene/glowing.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "image/luminance.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

namespace {

// Of one object or mesh. More balls aim better, and choosing among them takes longer. A rod that is thinner than its
// boxes fills them the better the smaller they are, and has but twice as many of half the size; a surface has four
// times as many, and with these little is gained.
constexpr std::size_t most_parts = 64, most_parts_of_rod = 512;
constexpr std::size_t growth_of_rod = 3;

// Of a scene with more copies of objects none gets balls: there would be millions.
constexpr std::uint64_t most_copies_with_parts = 10'000;

// A part counts as at least this share of its material's radiance, however dark the texture is at the places that are
// looked at.
constexpr float least_share = 1.0f / 32;

struct Part {
    BoundingSphere ball;
    float luminance;
};

// Roughly the luminance of what is in the box, by the colour at its centre and halfway to its corners.
float luminance_in(const Bounds& box, const Glowing& material) {
    constexpr int corners = 8;
    const auto at = [&](const glm::vec3& p) {
        return luminance(color_at(material.light, {p, {0, 0, 1}, std::nullopt}));
    };
    float sum = at(box.centre());
    for (int i = 0; i < corners; ++i) sum += at(0.5f * (box.centre() + box.corner(i)));
    return material.radiance * std::max(sum / (1 + corners), least_share);
}

Part part_in(const Bounds& box, const Glowing& material) {
    return {{box.centre(), 0.5f * box.diagonal()}, luminance_in(box, material)};
}

// A box that has some of the surface of a phase.
struct Box {
    Bounds bounds;
    std::size_t phase;
};

std::vector<Bounds> eighths(const Bounds& box) {
    std::vector<Bounds> parts;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 corner = box.corner(i), centre = box.centre();
        parts.push_back({glm::min(corner, centre), glm::max(corner, centre)});
    }
    return parts;
}

// Those of the boxes that may have some of the surface of the phase.
class SurfaceFinder {
  public:
    explicit SurfaceFinder(const Phased& tree)
        : evaluator_(record(tree)), values_(evaluator_.program().outputs.size()) {}

    std::vector<Box> eighths_with_surface(const Box& box) {
        static_assert(batch_size == 8);
        const auto& outputs = evaluator_.program().outputs;
        const auto output = std::ranges::find(outputs, Phase{static_cast<std::uint8_t>(box.phase)}, &Output::phase);
        if (output == outputs.end()) return {};
        const std::vector<Bounds> parts = eighths(box.bounds);
        BatchOfFloats x, y, z;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const glm::vec3 centre = parts[i].centre();
            x[i] = centre.x, y[i] = centre.y, z[i] = centre.z;
        }
        evaluator_.evaluate(x, y, z, values_, Evaluator::thread_workspace());
        const BatchOfFloats& distance = values_[static_cast<std::size_t>(output - outputs.begin())];
        // Rounding must not lose a surface that passes through a corner.
        const float radius = 1.001f * 0.5f * parts.front().diagonal();
        std::vector<Box> kept;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (std::abs(distance[i]) <= radius) kept.push_back({parts[i], box.phase});
        return kept;
    }

  private:
    Evaluator evaluator_;
    std::vector<BatchOfFloats> values_;
};

std::vector<Part> parts_of(const Phased& tree, std::span<const Material> materials) {
    const PhaseSet present = phases(tree);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < materials.size(); ++i)
        if (glows(materials[i]) && present.contains(Phase{static_cast<std::uint8_t>(i)})) boxes.push_back({{}, i});
    if (boxes.empty()) return {};
    const Bounds bounds = prepare_to_trace(tree).bounds;
    for (Box& box : boxes) box.bounds = bounds;
    SurfaceFinder finder(tree);
    for (;;) {
        std::vector<Box> finer;
        for (const Box& box : boxes) {
            for (const Box& part : finder.eighths_with_surface(box)) finer.push_back(part);
            if (finer.size() > most_parts_of_rod) break;
        }
        const bool is_rod = finer.size() < growth_of_rod * boxes.size();
        if (finer.empty() || finer.size() > (is_rod ? most_parts_of_rod : most_parts)) break;
        const bool is_finest = finer.front().bounds.diagonal() < 1e-4f * bounds.diagonal();
        boxes = std::move(finer);
        if (is_finest) break;
    }
    std::vector<Part> parts;
    for (const Box& box : boxes) parts.push_back(part_in(box.bounds, std::get<Glowing>(materials[box.phase])));
    return parts;
}

// Triangles in boxes: the largest set is halved along its longest side until there are enough.
std::vector<Part> parts_of(const Mesh& mesh) {
    struct Set {
        std::vector<std::uint32_t> triangles;
        Bounds bounds;
    };
    const auto set_of = [&](std::span<const std::uint32_t> triangles) {
        Set set{{triangles.begin(), triangles.end()}, {}};
        for (const std::uint32_t t : triangles)
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3& p = mesh.vertices[mesh.triangles[t][corner]];
                set.bounds = unite(set.bounds, {p, p});
            }
        return set;
    };
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<Set> sets{set_of(all)};
    const auto is_smaller = [](const Set& a, const Set& b) {
        const auto size = [](const Set& set) { return set.triangles.size() > 1 ? set.bounds.diagonal() : 0.0f; };
        return size(a) < size(b);
    };
    while (sets.size() < std::min(most_parts, mesh.triangles.size())) {
        std::ranges::pop_heap(sets, is_smaller);
        Set largest = std::move(sets.back());
        sets.pop_back();
        const glm::vec3 extent = largest.bounds.extent();
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const auto place = [&](std::uint32_t t) {
            const glm::uvec3& corners = mesh.triangles[t];
            return mesh.vertices[corners.x][axis] + mesh.vertices[corners.y][axis] + mesh.vertices[corners.z][axis];
        };
        const std::size_t half = largest.triangles.size() / 2;
        std::ranges::stable_sort(largest.triangles, {}, place);
        for (const auto& part : {std::span<const std::uint32_t>(largest.triangles).first(half),
                                 std::span<const std::uint32_t>(largest.triangles).subspan(half)}) {
            sets.push_back(set_of(part));
            std::ranges::push_heap(sets, is_smaller);
        }
    }
    std::vector<Part> parts;
    for (const Set& set : sets) parts.push_back(part_in(set.bounds, std::get<Glowing>(mesh.material)));
    return parts;
}

// A ball around the part's in all its places while the shutter is open, or nearly.
BoundingSphere placed(const BoundingSphere& ball, std::span<const Transform> places) {
    Bounds centres;
    double stretch = 0;
    for (const Transform& place : places) {
        const glm::vec3 centre(place(glm::dvec3(ball.centre)));
        centres = unite(centres, {centre, centre});
        stretch = std::max(stretch, place.stretch());
    }
    return {centres.centre(), 0.5f * centres.diagonal() + static_cast<float>(stretch) * ball.radius};
}

void add(const std::vector<Part>& parts, std::span<const Transform> places, Lights& lights) {
    for (const Part& part : parts)
        if (const BoundingSphere ball = placed(part.ball, places); ball.radius > 0.0f)
            lights.add(GlowingPart(ball, part.luminance));
}

void add_objects(Scene& scene) {
    const PlacedObjects& placed = scene.placed;
    if (placed.copies() > most_copies_with_parts) return;
    std::vector<std::vector<Part>> parts;
    for (const PlacedObject& object : placed.objects) try {
            parts.push_back(parts_of(object.tree, scene.materials));
        } catch (const ModelError&) {
            parts.emplace_back();  // it cannot be traced, which is said where that is tried
        }
    if (std::ranges::all_of(parts, &std::vector<Part>::empty)) return;
    // The places of each copy as the shutter opens, halfway, and as it closes.
    std::vector<std::vector<Transform>> places(placed.copies());
    std::vector<std::size_t> object_of(placed.copies());
    for (const double time : {0.0, 0.5, 1.0})
        placed.each_copy(
            [&](std::uint32_t copy, const PlacedObject& object, const Transform& to_scene) {
                places[copy].push_back(to_scene);
                object_of[copy] = static_cast<std::size_t>(&object - placed.objects.data());
                return true;
            },
            time);
    for (std::size_t copy = 0; copy < places.size(); ++copy) add(parts[object_of[copy]], places[copy], scene.lights);
}

}  // namespace

void find_glowing_parts(Scene& scene) {
    const auto join_group = [&](Material& material) {
        if (Glowing* glowing = std::get_if<Glowing>(&material))
            glowing->group_number = static_cast<std::uint32_t>(scene.lights.group_of(glowing->group));
    };
    for (Material& material : scene.materials) join_group(material);
    for (Mesh& mesh : scene.meshes) join_group(mesh.material);
    if (!scene.glows()) return;
    constexpr Transform in_place;
    if (scene.object)
        add(parts_of(scene.object, scene.materials), {&in_place, 1}, scene.lights);
    else
        add_objects(scene);
    for (const Mesh& mesh : scene.meshes)
        if (glows(mesh.material)) add(parts_of(mesh), {&in_place, 1}, scene.lights);
}

}  // namespace phasetree::tracer
