// Meshes that move while the shutter is open: rays at any time, against the scene read for that time; pictures, against
// closed forms; and motions that are rejected.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstring>
#include <numbers>

#include "phasetree/io/error.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "tracer/support/paths.hpp"
#include "tracer/support/straight_rays.hpp"

namespace test_moving_meshes {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A ball with bumps, as quadrilaterals by angles, with texture coordinates and smooth normals.
std::string bumpy_ball() {
    constexpr int around = 16, down = 8;
    std::string text;
    for (int i = 0; i <= down; ++i)
        for (int k = 0; k <= around; ++k) {
            const double a = 2 * std::numbers::pi * (k % around) / around, b = std::numbers::pi * i / down;
            const double r = 1 + 0.15 * std::sin(5 * a) * std::sin(b) * std::sin(b);
            text += fmt::format("v {} {} {}\nvt {} {}\n", r * std::sin(b) * std::cos(a), r * std::sin(b) * std::sin(a),
                                r * std::cos(b), static_cast<double>(k) / around, static_cast<double>(i) / down);
        }
    for (int i = 0; i < down; ++i)
        for (int k = 0; k < around; ++k) {
            const int v = 1 + i * (around + 1) + k, w = v + around + 1;
            text += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\nf {0}/{0} {2}/{2} {3}/{3}\n", v, w, w + 1, v + 1);
        }
    return text;
}

// A box as triangles with its lower corner there.
std::string box_of(const glm::vec3& low, const glm::vec3& size) {
    std::string text;
    for (int i = 0; i < 8; ++i)
        text += fmt::format("v {} {} {}\n", low.x + (i & 1 ? size.x : 0), low.y + (i & 2 ? size.y : 0),
                            low.z + (i & 4 ? size.z : 0));
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

// A folder with meshes and a map of normals that leans to one side everywhere.
class Files {
  public:
    Files() {
        phasetree::support::write_text(folder_ / "ball.obj", bumpy_ball());
        phasetree::support::write_text(folder_ / "wall.obj", box_of({-2, -0.5f, -20}, {4, 1, 40}));
        phasetree::support::write_text(folder_ / "lamp.obj", box_of({-0.2f, -0.2f, -0.2f}, {0.4f, 0.4f, 0.4f}));
        const auto out = OIIO::ImageOutput::create(name_of("leaning.png"));
        REQUIRE(out->open(name_of("leaning.png"), OIIO::ImageSpec(1, 1, 3, OIIO::TypeDesc::UINT8)));
        const unsigned char pixel[] = {190, 110, 230};
        REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixel));
        out->close();
    }
    std::string name_of(const std::string& file) const { return (folder_ / file).string(); }

  private:
    phasetree::support::TemporaryDirectory folder_;
};

std::string scene_text(const std::string& objects, const std::string& meshes, const std::string& render,
                       const std::string& rest = R"("lights": [{"constant": {}}],
                            "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]})") {
    return R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}}, )" + objects + R"(, "meshes": [)" + meshes +
           R"(], )" + rest + R"(, "render": {)" + render + "}}";
}

const std::string one_tree = R"("tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.4}}}})";
const std::string several =
    R"("objects": [{"name": "ball", "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.4}}}},
        "transform": {"keys": [[0, {"translate": {"by": [0, 0, 0]}}], [4, {"translate": {"by": [0.5, 0, 0]}}]]}}])";

Hit hit_at(const TracedGeometry& geometry, const glm::vec3& origin, const glm::vec3& d, float time) {
    PathCounters counters;
    const TracedGeometry::Inside inside = geometry.inside(origin, time);
    return geometry.intersect({origin, d, inside.phase, {}, inside.in}, counters);
}

// Whether two hits agree within rounding.
bool agree(const Hit& a, const Hit& b) {
    const auto *s = std::get_if<Surface>(&a), *t = std::get_if<Surface>(&b);
    if (!s || !t) return !s && !t;
    const auto is_near = [](const glm::vec3& p, const glm::vec3& q, float by) { return glm::length(p - q) < by; };
    const auto &m = s->place.mesh, &n = t->place.mesh;
    if (s->object != t->object || m.has_value() != n.has_value()) return false;
    if (m) {
        if (!(glm::length(m->uv - n->uv) < 2e-4f) || !is_near(m->tangent, n->tangent, 2e-3f) ||
            !is_near(m->bitangent, n->bitangent, 2e-3f))
            return false;
        for (int i = 0; i < 2; ++i)
            if (!is_near(m->gradients[i], n->gradients[i], 1e-3f * (1 + glm::length(n->gradients[i])))) return false;
    }
    return std::abs(s->distance - t->distance) < 2e-4f && is_near(s->geometric_normal, t->geometric_normal, 1e-3f) &&
           is_near(s->normal, t->normal, 3e-3f) && is_near(s->place.position, t->place.position, 2e-4f) &&
           is_near(s->near_side.origin, t->near_side.origin, 2e-4f) && s->place.is_back == t->place.is_back;
}

// The share of the time, averaged over the column from x to x + 1, in which a wall that is 4 wide covers it, if its
// middle moves from `start` by `moved` at a constant speed.
double covered_time(double x, double start, double moved) {
    double sum = 0;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
        const double at = x + (i + 0.5) / n;
        sum += std::clamp((at + 2 - start) / moved, 0.0, 1.0) - std::clamp((at - 2 - start) / moved, 0.0, 1.0);
    }
    return sum / n;
}

bool equal_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

}  // namespace

TEST_CASE("rays at any time meet moving meshes as they meet those of the scene read for that time") {
    const Files files;
    // Two turns, so that straight lines between a few positions would be far off.
    const std::string meshes =
        fmt::format(R"({{"obj": {{"file": "{}", "translate": {{"keys": [[0, [-1, 0.5, 0]], [1.7, [1, 0, 0.5]],
            [3, [0, -1, 0]]]}}, "rotate_z": {{"keys": [[1, 0], [3, 720]]}}, "scale": {{"keys": [[1, 1], [3, 1.6]]}},
            "material": {{"diffuse": {{"color": [1, 1, 1], "normal_map": {{"file": "{}"}}}}}}, "opacity_cutoff": 0.5,
            "opacity": {{"field": {{"of": {{"sphere": {{"radius": 0.9}}}}, "ramp": [[0, 0], [0.000001, 1]]}}}}}}}},
            {{"floor": {{"height": {{"keys": [[1, -3], [3, -2]]}}, "material": {{"diffuse": {{"color": [1, 1, 1]}}}}}}}})",
                    files.name_of("ball.obj"), files.name_of("leaning.png"));
    for (const std::string& objects : {one_tree, several}) {
        const Scene moving =
            read_scene(Document::from_text(scene_text(objects, meshes, R"("shutter": [1, 3])"), "test.json"));
        REQUIRE(moving.moves());
        const TracedGeometry geometry(moving);
        const Document still = Document::from_text(scene_text(objects, meshes, ""), "test.json");
        Random random(7);
        int met = 0, edges = 0, holes = 0;
        for (int i = 0; i < 40; ++i) {
            const float time = uniform(random, 0, 1);
            const Scene then = read_scene(still.at(1 + 2 * static_cast<double>(time)));
            REQUIRE_FALSE(then.moves());
            const TracedGeometry expected(then);
            for (int k = 0; k < 200; ++k) {
                const glm::vec3 d = direction(random);
                const glm::vec3 target(uniform(random, -1.5f, 1.5f), uniform(random, -1.5f, 1.5f),
                                       uniform(random, -1.5f, 1.5f));
                const glm::vec3 origin = target - 6.0f * d;
                const Hit a = hit_at(geometry, origin, d, time), b = hit_at(expected, origin, d, 0);
                const auto* surface = std::get_if<Surface>(&b);
                met += surface && surface->object == 1;
                holes += surface && surface->object != 1 && glm::length(target) < 0.5f;
                if (agree(a, b)) continue;
                // Only where the scene itself changes within rounding: at edges, and where a hole ends.
                bool is_edge = false;
                for (int axis = 0; axis < 6; ++axis) {
                    glm::vec3 aside(0.0f);
                    aside[axis / 2] = axis % 2 == 0 ? 2e-4f : -2e-4f;
                    is_edge = is_edge || !agree(b, hit_at(expected, origin + aside, d, 0));
                }
                CHECK(is_edge);
                ++edges;
            }
        }
        CHECK(met > 2000);
        CHECK(holes > 20);
        CHECK(edges < 400);
        // At another time, most rays meet the mesh elsewhere.
        const Scene then = read_scene(still.at(2.02));
        const TracedGeometry later(then);
        int same = 0;
        for (int k = 0; k < 200; ++k) {
            const glm::vec3 d = direction(random);
            const glm::vec3 origin = glm::vec3(0.2f) - 6.0f * d;
            same += agree(hit_at(geometry, origin, d, 0.5f), hit_at(later, origin, d, 0));
        }
        CHECK(same < 60);
    }
}

TEST_CASE("a blurred mesh covers each pixel for as long as it is before it, also behind glass") {
    const Files files;
    // A pane before the wall, and none. Of the light from the wall's side, 2n/(n² + 1) passes the pane (Born and Wolf,
    // Principles of Optics, 1.6.4, summed over all internal reflections without interference).
    const auto picture = [&](const std::string& objects, const std::string& shutter, int threads) {
        const std::string wall =
            fmt::format(R"({{"obj": {{"file": "{}", "translate": {{"keys": [[0, [-3, 0, 0]], [2, [1, 0, 0]]]}},
                "material": {{"diffuse": {{"color": [0, 0, 0]}}}}}}}})",
                        files.name_of("wall.obj"));
        const Scene scene = read_scene(Document::from_text(
            scene_text(objects, wall, R"("width": 40, "height": 8, "samples": 1024)" + shutter,
                       R"("lights": [{"constant": {}}], "camera": {"orthographic": {"position": [0, -9, 0],
                          "look_at": [0, 0, 0], "height": 8, "filter": "box"}})"),
            "test.json"));
        const World world(scene);
        RenderJob job;
        job.pixels = scene.film.whole();
        job.threads = threads;
        return render(world, scene, job).image;
    };
    const auto worst = [](const Image& image, double passes, double moved) {
        double most = 0;
        for (int x = 0; x < image.width; ++x) {
            double sum = 0;
            for (int y = 0; y < image.height; ++y)
                sum += static_cast<double>(image.pixels[static_cast<std::size_t>(y * image.width + x)].y);
            const double expected = 1 - passes * covered_time(x - 20, -3, moved);
            most = std::max(most, std::abs(sum / image.height - expected));
        }
        return most;
    };
    const std::string aside =
        R"("tree": {"set": {"phase": "glass", "of": {"translate": {"by": [0, 50, 0], "of": {"sphere": {"radius": 1}}}}}})";
    const std::string pane =
        R"("tree": {"set": {"phase": "glass", "of": {"translate": {"by": [0, -3, 0], "of": {"box": {"size": [90, 1, 90]}}}}}})";
    const std::string shutter = R"(, "shutter": [0, 2])";
    const double through_pane = 2 * 1.5 / (1.5 * 1.5 + 1);
    const Image free = picture(aside, shutter, 1), behind = picture(pane, shutter, 1);
    // A column has 8 × 1024 samples, whose mean has a standard error of at most 0.0055; most are stratified.
    CHECK(worst(free, 1, 4) < 0.006);
    CHECK(worst(behind, through_pane, 4) < 0.02);
    // A path that is longer or missing would be detected.
    CHECK(worst(free, 1, 4.1) > 0.012);
    CHECK(worst(behind, through_pane, 4.4) > 0.04);
    CHECK(worst(behind, through_pane, 1e-9) > 0.5);
    CHECK(equal_bits(free, picture(aside, shutter, 3)));
    CHECK(equal_bits(behind, picture(pane, shutter, 3)));
    // A mesh whose motion ends before the shutter opens is at rest, as one whose shutter opens for an instant.
    CHECK(equal_bits(picture(aside, R"(, "shutter": [2, 2])", 1), picture(aside, R"(, "shutter": [2, 4])", 1)));
}

TEST_CASE("shadow rays find a moving lamp where it is") {
    const Files files;
    const auto mean_with = [&](Techniques techniques) {
        const std::string meshes =
            fmt::format(R"({{"floor": {{"height": -2, "material": {{"diffuse": {{"color": [0.5, 0.5, 0.5]}}}}}}}},
                {{"obj": {{"file": "{}", "translate": {{"keys": [[0, [-0.5, 0, 2]], [1, [0.5, 0, 2.2]]]}},
                "scale": {{"keys": [[0, 1], [1, 1.5]]}}, "material": {{"glowing": {{"radiance": 5}}}}}}}})",
                        files.name_of("lamp.obj"));
        Moments moments;
        for (int seed = 1; seed <= 16; ++seed) {
            Scene scene = read_scene(Document::from_text(
                scene_text(
                    one_tree, meshes,
                    fmt::format(R"("shutter": [0, 1], "width": 16, "height": 8, "samples": 256, "seed": {})", seed),
                    R"("lights": [], "camera": {"position": [0, -7, 9], "look_at": [0, 0, -2], "fov": 20})"),
                "test.json"));
            scene.settings.techniques = techniques;
            const World world(scene);
            double sum = 0;
            for (const glm::vec3& pixel : image_of(world, scene).pixels) sum += static_cast<double>(pixel.y);
            moments.add(sum);
        }
        return moments;
    };
    const Moments all = mean_with(Techniques::all), directions = mean_with(Techniques::directions_alone),
                  shadow_rays = mean_with(Techniques::shadow_rays_alone);
    for (const Moments& alone : {directions, shadow_rays}) {
        const double error = std::hypot(all.standard_error(), alone.standard_error());
        CHECK(phasetree::tests::normal_two_sided((all.mean() - alone.mean()) / error) > 1e-4);
        // A tenth less would be detected.
        CHECK(phasetree::tests::normal_two_sided((all.mean() - 0.9 * alone.mean()) / error) < 1e-4);
    }
    CHECK(all.variance() < 0.25 * directions.variance());
}

TEST_CASE("meshes that cannot move so are rejected, with the place") {
    const Files files;
    const auto message = [&](const std::string& placement, const std::string& shutter = "[0, 1]") {
        try {
            (void)read_scene(Document::from_text(
                scene_text(one_tree,
                           "\n{\"obj\": {\"file\": \"" + files.name_of("ball.obj") +
                               R"(", "material": {"diffuse": {"color": [1, 1, 1]}}, )" + placement + "}}\n",
                           R"("shutter": )" + shutter),
                "test.json"));
        } catch (const SceneError& e) {
            return fmt::format("{}: {}", e.line(), e.what());
        }
        return std::string();
    };
    CHECK(message(R"("scale": {"keys": [[0, 1], [1, 2]]})") == "");
    CHECK(message(R"("scale": {"keys": [[0, 1], [1, 0]]})").find("scale") != std::string::npos);
    CHECK(message(R"("scale": {"keys": [[0, 1], [1, 1e-30]]})").find("2: ") == 0);
    CHECK(message(R"("scale": {"keys": [[0, 1], [1, 1e-30]]})").find("too small, too large or too far away") !=
          std::string::npos);
    CHECK(message(R"("translate": {"keys": [[0, [0, 0, 0]], [1, [0, 1e30, 0]]]})").find("too far away") !=
          std::string::npos);
    CHECK(message(R"("translate": {"keys": [[0, [0, 0, 0]], [1, [0, 1e30, 0]]]})", "[0, 0]") == "");
    CHECK(message(R"("scael": 1)").find("scale") != std::string::npos);
}

}  // namespace test_moving_meshes
