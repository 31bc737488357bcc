#include "view/selection_mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>
#include <utility>

#include "phasetree/math/float_mode.hpp"
#include "phasetree/tree/value_source.hpp"
#include "studio/layout.hpp"
#include "studio/pointer.hpp"
#include "view/ladder.hpp"

namespace phasetree::tracer::view {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int block_size = 8;
constexpr int most_surfaces = 64;  // along one ray

// Decides which surfaces of a picture belong to the selection.
class Selected {
  public:
    Selected(const Picture& picture, const SelectedParts& parts) : viewed_(*picture.viewed) {
        const Scene& scene = picture.prepared->scene();
        for (std::size_t i = 1; i < scene.phases.names.size(); ++i)
            if (std::ranges::find(parts.phases, scene.phases.names[i]) != parts.phases.end())
                phases_.insert(static_cast<int>(i));
        if (!viewed_.file) return;
        for (const std::string& pointer : parts.pointers) try {
                const Value value = studio::value_at(*viewed_.file, pointer);
                spans_.push_back(studio::span_of(*viewed_.file, value));
                if (const auto name = mesh_name(pointer)) mesh_names_.insert(*name);
            } catch (const std::exception&) {
                // The picture shows another text than the page.
            }
    }

    bool is_any() const { return !phases_.empty() || !spans_.empty(); }
    bool contains(const Surface& surface, const Scene& scene) const {
        if (!surface.entered) return is_selected_mesh(scene.meshes[surface.object - 1].name);
        const Phase near = surface.near_side.phase, far = *surface.entered;
        if (phases_.contains(near.index) || phases_.contains(far.index)) return true;
        if (spans_.empty()) return false;
        const glm::vec3& p = surface.near_side.origin;
        return is_decided_within(scene.object, p, far) || is_decided_within(scene.object, p, near);
    }

  private:
    // The name of a part of a glTF file begins with the name of the file's mesh.
    bool is_selected_mesh(std::string_view name) const {
        return std::ranges::any_of(mesh_names_, [&](const std::string& selected) {
            if (!name.starts_with(selected)) return false;
            const std::string_view rest = name.substr(selected.size());
            return rest.empty() || (rest.size() > 1 && rest[0] == ' ' && (rest[1] < '0' || rest[1] > '9'));
        });
    }
    bool is_decided_within(const Phased& object, const glm::vec3& p, Phase phase) const {
        if (phase == phasetree::vacuum) return false;
        for (const NodeOnPath& step : value_source(object, p, phase)) {
            const auto place = viewed_.place_of(step.node);
            if (!place || place->file != viewed_.file->name()) continue;
            const auto covers = [&](const studio::Span& s) {
                return s.begin <= place->offset && place->offset < s.end;
            };
            if (std::ranges::any_of(spans_, covers)) return true;
        }
        return false;
    }
    // The name of the mesh at /meshes/3, as Mesh::name; nullopt for anything else.
    std::optional<std::string> mesh_name(const std::string& pointer) const {
        const studio::PointerTokens tokens = studio::pointer_tokens(pointer);
        if (tokens.size() != 2 || tokens[0] != "meshes") return std::nullopt;
        const auto kind = [](const Value& mesh) { return mesh.is_object() ? std::string((*mesh.begin()).key()) : ""; };
        const Value list = studio::value_at(*viewed_.file, "/meshes");
        const std::size_t index = studio::index_of(tokens[1]).value();
        std::size_t i = 0, count = 0;
        std::string name;
        for (const Value mesh : list) {
            if (i == index) name = kind(mesh);
            ++i;
        }
        i = 0;
        for (const Value mesh : list)
            if (i++ <= index && kind(mesh) == name) ++count;
        return count > 1 ? fmt::format("{} {}", name, count) : name;
    }

    const ViewedScene& viewed_;
    std::set<int> phases_;
    std::vector<studio::Span> spans_;  // of the file's text
    std::set<std::string> mesh_names_;
};

// Computes the pixels of a mask one by one, each at most once.
class Pixels {
  public:
    Pixels(const Picture& picture, const Selected& selected, glm::ivec2 size, Clock::time_point end)
        : geometry_(picture.prepared->world().geometry()),
          scene_(picture.prepared->scene()),
          selected_(selected),
          camera_(picture.camera, picture.viewed->scene.film.resolution()),
          size_(size),
          scale_(glm::vec2(picture.viewed->scene.film.resolution()) / glm::vec2(size)),
          end_(end),
          known_(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), State::unknown) {}

    bool at(int x, int y) {
        State& state = known_[index(x, y)];
        if (state == State::unknown) state = look(glm::vec2(x, y) + 0.5f) ? State::selected : State::other;
        return state == State::selected;
    }
    // Sets a pixel that is still unknown.
    void fill(int x, int y, bool is_selected) {
        State& state = known_[index(x, y)];
        if (state == State::unknown) state = is_selected ? State::selected : State::other;
    }
    std::vector<bool> all() const {
        std::vector<bool> result;
        for (const State state : known_) result.push_back(state == State::selected);
        return result;
    }

  private:
    enum class State : char { unknown, selected, other };

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x);
    }
    bool look(const glm::vec2& pixel) const {
        if (Clock::now() > end_) throw ModelError("finding the selection in the picture takes too long");
        // The middle of the unit square is the middle of the lens.
        const CameraRay through = camera_.generate(pixel * scale_, glm::vec2(0.5f));
        Ray ray{through.origin, through.direction, geometry_.label(through.origin), {}};
        PathCounters counters;
        for (int i = 0; i < most_surfaces; ++i) {
            const Hit hit = geometry_.intersect(ray, counters);
            const auto* surface = std::get_if<Surface>(&hit);
            if (!surface) return false;
            if (selected_.contains(*surface, scene_)) return true;
            if (!surface->far_side) return false;
            ray = surface->transmitted(through.direction);
        }
        return false;
    }

    const TracedGeometry& geometry_;
    const Scene& scene_;
    const Selected& selected_;
    const Camera camera_;
    const glm::ivec2 size_;
    const glm::vec2 scale_;
    const Clock::time_point end_;
    std::vector<State> known_;
};

// Decides the corners of blocks first, and all pixels of a block only if its corners differ or the border of the
// selection enters it from a neighbour.
std::vector<bool> found(Pixels& pixels, glm::ivec2 size) {
    const glm::ivec2 blocks = (size + block_size - 1) / block_size;
    const auto first = [](int block) { return block * block_size; };
    const auto last = [](int block, int most) { return std::min((block + 1) * block_size, most - 1); };
    std::vector<char> is_entered(static_cast<std::size_t>(blocks.x) * static_cast<std::size_t>(blocks.y), char{0});
    std::deque<glm::ivec2> waiting;
    const auto enter = [&](int bx, int by) {
        if (bx < 0 || by < 0 || bx >= blocks.x || by >= blocks.y) return;
        const auto i = static_cast<std::size_t>(by) * static_cast<std::size_t>(blocks.x) + static_cast<std::size_t>(bx);
        if (std::exchange(is_entered[i], char{1}) != 0) return;
        waiting.emplace_back(bx, by);
    };
    for (int by = 0; by < blocks.y; ++by)
        for (int bx = 0; bx < blocks.x; ++bx) {
            const int x0 = first(bx), x1 = last(bx, size.x), y0 = first(by), y1 = last(by, size.y);
            const bool corner = pixels.at(x0, y0);
            if (pixels.at(x1, y0) != corner || pixels.at(x0, y1) != corner || pixels.at(x1, y1) != corner)
                enter(bx, by);
        }
    while (!waiting.empty()) {
        const glm::ivec2 b = waiting.front();
        waiting.pop_front();
        const int x0 = first(b.x), x1 = last(b.x, size.x), y0 = first(b.y), y1 = last(b.y, size.y);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) (void)pixels.at(x, y);
        for (int x = x0; x < x1; ++x) {
            if (pixels.at(x, y0) != pixels.at(x + 1, y0)) enter(b.x, b.y - 1);
            if (pixels.at(x, y1) != pixels.at(x + 1, y1)) enter(b.x, b.y + 1);
        }
        for (int y = y0; y < y1; ++y) {
            if (pixels.at(x0, y) != pixels.at(x0, y + 1)) enter(b.x - 1, b.y);
            if (pixels.at(x1, y) != pixels.at(x1, y + 1)) enter(b.x + 1, b.y);
        }
    }
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            pixels.fill(x, y, pixels.at(x / block_size * block_size, y / block_size * block_size));
    return pixels.all();
}

}  // namespace

SelectionMask selection_mask(const Picture& picture, const SelectedParts& parts, std::chrono::milliseconds longest) {
    const FlushSubnormals flush;
    const glm::ivec2 resolution = picture.viewed->scene.film.resolution();
    const int scale = (std::max(resolution.x, resolution.y) + most_pixels_of_mask - 1) / most_pixels_of_mask;
    SelectionMask mask{picture.number, coarser(resolution, scale), {}};
    const Selected selected(picture, parts);
    if (!selected.is_any()) {
        mask.is_selected.assign(static_cast<std::size_t>(mask.size.x) * static_cast<std::size_t>(mask.size.y), false);
        return mask;
    }
    Pixels pixels(picture, selected, mask.size, Clock::now() + longest);
    mask.is_selected = found(pixels, mask.size);
    return mask;
}

}  // namespace phasetree::tracer::view
