#include <algorithm>
#include <array>

#include "image/luminance.hpp"
#include "scene/emissive_parts.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t most_sets = 16;

struct Corner {
    glm::vec3 p;
    glm::vec2 uv{0};
    glm::vec3 color{1};
};
using Triangle = std::array<Corner, 3>;

struct Set {
    std::vector<Triangle> triangles;
    Bounds bounds{};

    explicit Set(std::vector<Triangle> of) : triangles(std::move(of)) {
        for (const Triangle& triangle : triangles)
            for (const Corner& corner : triangle) bounds = unite(bounds, {corner.p, corner.p});
    }
};

Corner middle(const Corner& a, const Corner& b) {
    return {0.5f * (a.p + b.p), 0.5f * (a.uv + b.uv), 0.5f * (a.color + b.color)};
}

std::array<Set, 2> halves(const Triangle& triangle) {
    const auto length = [&](std::size_t i) { return glm::distance(triangle[i].p, triangle[(i + 1) % 3].p); };
    std::size_t longest = 0;
    for (const std::size_t i : {std::size_t(1), std::size_t(2)})
        if (length(i) > length(longest)) longest = i;
    const Corner &a = triangle[longest], &b = triangle[(longest + 1) % 3], &c = triangle[(longest + 2) % 3];
    const Corner between = middle(a, b);
    return {Set({{a, between, c}}), Set({{between, b, c}})};
}

std::array<Set, 2> halves(Set set) {
    if (set.triangles.size() == 1) return halves(set.triangles.front());
    const glm::vec3 extent = set.bounds.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto place = [axis](const Triangle& t) { return t[0].p[axis] + t[1].p[axis] + t[2].p[axis]; };
    std::ranges::stable_sort(set.triangles, {}, place);
    const auto half = set.triangles.begin() + static_cast<std::ptrdiff_t>(set.triangles.size() / 2);
    return {Set({set.triangles.begin(), half}), Set({half, set.triangles.end()})};
}

std::vector<Triangle> triangles_of(const Mesh& mesh) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle triangle;
        for (int corner = 0; corner < 3; ++corner) {
            const auto i = static_cast<std::size_t>(corner);
            triangle[i].p = mesh.vertices[mesh.triangles[t][corner]];
            if (!mesh.uv.empty()) triangle[i].uv = mesh.uv.at(mesh.triangles, t, corner);
            if (!mesh.colors.empty()) triangle[i].color = mesh.colors.at(mesh.triangles, t, corner);
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

// Samples the light at the centres of at most 16 triangles, evenly spaced in the list.
float luminance_of(const Set& set, const Glowing& material) {
    constexpr std::size_t most = 16;
    const std::size_t count = std::min(set.triangles.size(), most);
    float sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [a, b, c] = set.triangles[i * set.triangles.size() / count];
        const MeshCoordinates middle{.uv = (a.uv + b.uv + c.uv) / 3.0f, .color = (a.color + b.color + c.color) / 3.0f};
        sum += luminance(color_at(material.light, {(a.p + b.p + c.p) / 3.0f, {0, 0, 1}, middle}));
    }
    return material.radiance * std::max(sum / static_cast<float>(count), least_brightness);
}

}  // namespace

std::vector<EmissiveBall> parts_of_mesh(const Mesh& mesh) {
    if (mesh.triangles.empty()) return {};
    const auto is_smaller = [](const Set& a, const Set& b) { return a.bounds.diagonal() < b.bounds.diagonal(); };
    std::vector<Set> sets{Set(triangles_of(mesh))};
    while (sets.size() < most_sets && sets.front().bounds.diagonal() > 0.0f) {
        std::ranges::pop_heap(sets, is_smaller);
        Set largest = std::move(sets.back());
        sets.pop_back();
        for (Set& half : halves(std::move(largest))) {
            sets.push_back(std::move(half));
            std::ranges::push_heap(sets, is_smaller);
        }
    }
    std::vector<EmissiveBall> parts;
    for (const Set& set : sets) parts.push_back(part_in(set.bounds, luminance_of(set, *emission_of(mesh.material))));
    return parts;
}

}  // namespace phasetree::tracer
