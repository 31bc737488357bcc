// Points of surfaces follow the pointer: for every number of the examples of all nodes that moves a visible point, the
// changed text is read again, and its surface must pass the pointer's ray within a pixel.
#include "view/drag.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <iterator>
#include <map>
#include <set>

#include "camera/camera.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/scene.hpp"
#include "source_directory.hpp"

namespace test_drag {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::view;

namespace {

const studio::Vocabulary& vocabulary() {
    static const studio::Vocabulary words;
    return words;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A scene, its camera, and rays through its picture.
class Viewed {
  public:
    Viewed(const std::string& text, const std::string& name)
        : parse_([name](std::string now) { return Document::from_text(std::move(now), name); }),
          scene_(read_scene(parse_(text))),
          camera_(scene_.camera, scene_.film.resolution()),
          object(parse_(text), parse_),
          parameters(drag_parameters(object.document(), vocabulary(), object.size())),
          tracer_(scene_.object) {}

    // The surface that is seen at a place of the picture.
    std::optional<InterfacePoint> seen_at(const glm::dvec2& place) const {
        const CameraRay ray = camera_.generate(place, glm::vec2(0.5f));
        const auto crossing =
            tracer_.first_crossing(ray.origin, ray.direction, 0, 1e6f, std::nullopt, Evaluator::thread_workspace());
        if (!crossing) return std::nullopt;
        return InterfacePoint{crossing->to, crossing->from, glm::dvec3(crossing->p_in)};
    }
    DragTarget target(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec3& point) const {
        const auto ray = [&](const glm::dvec2& place) {
            const CameraRay r = camera_.generate(place, glm::vec2(0.5f));
            return std::pair(glm::dvec3(r.origin), glm::normalize(glm::dvec3(r.direction)));
        };
        const auto [origin, direction] = ray(to);
        const auto [start, facing] = ray(from);
        const auto [next_origin, next] = ray(from + glm::dvec2(1, 0));
        return {origin, direction, facing, glm::length(glm::cross(next, point - next_origin))};
    }
    // How far the surface is from the pointer's ray, in pixels: read again from the changed text. At most 2.
    double miss(const Dragged& dragged, const InterfacePoint& grabbed, const DragTarget& target) const {
        const glm::dvec3 p = dragged.position;
        const double aside = glm::length(glm::cross(target.direction, p - target.origin)) / target.pixel;
        const Document document = parse_(with_numbers(object.document(), dragged.values));
        const PreciseEvaluator changed(read_scene(document).object);
        const auto [value, gradient, weight, inner, inner_by] =
            changed.interface_sample(p, grabbed.inside, grabbed.outside);
        const glm::dvec3 normal = glm::normalize(gradient);
        for (const double reach : {0.125, 0.25, 0.5, 1.0})
            if (changed.label(p - reach * target.pixel * normal) != changed.label(p + reach * target.pixel * normal))
                return aside + reach;
        return 2;
    }
    // The direction of a motion in the picture; to the right for one along the ray.
    glm::dvec2 direction_of(const Influence& one, const glm::dvec2& from, const glm::dvec3& p) const {
        const auto aside = [&](const glm::dvec2& place) {
            const CameraRay r = camera_.generate(place, glm::vec2(0.5f));
            const glm::dvec3 d = glm::normalize(glm::dvec3(r.direction)), o(r.origin);
            return (o - p) - d * glm::dot(o - p, d);
        };
        const glm::dvec3 here = aside(from), x = aside(from + glm::dvec2(1, 0)) - here,
                         y = aside(from + glm::dvec2(0, 1)) - here;
        const glm::dvec2 seen(glm::dot(one.motion, x) / glm::dot(x, x), glm::dot(one.motion, y) / glm::dot(y, y));
        const double length = glm::length(seen) * glm::length(x);
        return length > 0.05 * glm::length(one.motion) ? glm::normalize(seen) : glm::dvec2(1, 0);
    }
    glm::ivec2 resolution() const { return scene_.film.resolution(); }

  private:
    VariedObject::Parse parse_;
    Scene scene_;
    Camera camera_;

  public:
    VariedObject object;
    std::vector<DragParameter> parameters;

  private:
    InterfaceTracer tracer_;
};

// What became of the drags of a number.
struct Outcome {
    double strength = 0;
    int drags = 0, followed = 0;
    double worst = 0;  // of those that claim to follow
};

}  // namespace

TEST_CASE("the surface follows the pointer within a pixel, for every number that moves it") {
    const std::filesystem::path nodes = std::filesystem::path(source_directory()) / "scenes/nodes";
    const std::string studio = text_of(nodes / "studio.json");
    std::map<std::string, bool> is_dragged;
    for (const char* const folder : {"fields", "objects", "warps"})
        for (const auto& entry : std::filesystem::directory_iterator(nodes / folder)) {
            if (entry.path().extension() != ".json") continue;
            if (const char* only = std::getenv("ONLY"); only && entry.path().stem() != only) continue;
            std::string text = studio;
            text.replace(text.find("@TREE@"), 6, text_of(entry.path()));
            const auto begin = std::chrono::steady_clock::now();
            const Viewed viewed(text, (nodes / "studio.json").string());
            std::map<std::string, Outcome> outcomes;
            int points = 0;
            std::size_t readings = 0;
            for (int y = 12; y < viewed.resolution().y; y += 17)
                for (int x = 12; x < viewed.resolution().x; x += 17) {
                    const glm::dvec2 from(x + 0.3, y + 0.6);
                    const auto point = viewed.seen_at(from);
                    if (!point) continue;
                    ++points;
                    const std::vector<Influence> found = influences(viewed.object, *point, viewed.parameters);
                    for (const Influence& one : found) {
                        Outcome& outcome = outcomes[one.parameter.pointer];
                        if (outcome.drags >= 8 || one.strength < 0.02) continue;
                        const glm::dvec2 along = viewed.direction_of(one, from, point->position);
                        for (const auto& by : {6.0 * along, -6.0 * along}) {
                            const DragTarget target = viewed.target(from, from + by, point->position);
                            const DragParameter alone[] = {one.parameter};
                            const Dragged dragged = drag(viewed.object, *point, alone, target);
                            readings += dragged.readings;
                            ++outcome.drags;
                            outcome.strength = std::max(outcome.strength, one.strength);
                            if (!dragged.follows) {
                                if (std::getenv("ONLY"))
                                    fmt::print(
                                        "      fail {} from {} {} by {:.2f} {:.2f}: miss {} sticks {} strength {} "
                                        "value {} -> {} cos {:.3f} flat {:.3f}\n",
                                        one.parameter.pointer, from.x, from.y, by.x, by.y, dragged.miss, dragged.sticks,
                                        one.strength, one.parameter.value, dragged.values.begin()->second,
                                        glm::dot(glm::normalize(one.motion), target.facing),
                                        one.slope / glm::length(one.motion));
                                continue;
                            }
                            ++outcome.followed;
                            const double miss = viewed.miss(dragged, *point, target);
                            outcome.worst = std::max(outcome.worst, miss);
                            if (miss > 1)
                                fmt::print("      bad {} from {} {} by {} {}: {} {}\n", one.parameter.pointer, from.x,
                                           from.y, by.x, by.y, miss, dragged.values.begin()->second);
                        }
                    }
                }
            fmt::print(
                "{}: {} points, {} ms, {} readings\n", entry.path().stem().string(), points,
                std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin).count(),
                viewed.object.readings());
            for (const auto& [pointer, o] : outcomes)
                fmt::print("    {:60} {:.3f} {}/{} worst {:.3f}\n", pointer, o.strength, o.followed, o.drags, o.worst);
        }
}

}  // namespace test_drag
