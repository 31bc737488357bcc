// Compares normals of crossings with differences of the oracle in double: at points where coordinates tie, and along
// rays, many of which graze.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <set>

#include "math/dual.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/concepts.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/normal_checks.hpp"
#include "support/random_mesh.hpp"

namespace test_normals {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct Solid {
    std::string_view name;
    Field field;
};

/// Solids of every primitive, around the origin and with sizes that floats represent exactly. Profiles are extruded and
/// revolved; space-filling primitives are cut to a box.
class Solids {
  public:
    template <class N>
    void add(N node) {
        const Field f(std::move(node));
        names.insert(std::string(N::info.name));
        const Bounds b = bounds(f);
        if (b.finite()) {
            list.push_back({N::info.name, f});
        } else if (std::isfinite(b.extent().x) && std::isfinite(b.extent().y)) {
            list.push_back({N::info.name, Extrude{.of = f, .height = 1}});
            list.push_back({N::info.name, Revolve{.of = f, .offset = 0}});
            list.push_back({N::info.name, Revolve{.of = f, .offset = 1}});
        } else {
            list.push_back({N::info.name, Intersection{.of = {f, Box{.size = glm::vec3(1.5f)}}}});
        }
    }
    void add_made_of(std::string_view name, Field f) { list.push_back({name, std::move(f)}); }

    std::vector<Solid> list;
    std::set<std::string> names;
};

FromFile<SirenNetwork> ball_like_network() {
    SirenNetwork network;
    network.radius = 1;
    network.layers.push_back({3, 2, {1, 1, 1, 1, -1, 1}, {0.25f, 0.25f}});
    network.layers.push_back({2, 1, {1, 1}, {-0.25f}});
    FromFile<SirenNetwork> file;
    file.content = std::make_shared<const SirenNetwork>(std::move(network));
    return file;
}
/// An octagon with a square hole.
FromFile<TextOutlines> octagonal_letter() {
    const auto contour = [](std::vector<glm::vec2> corners) {
        TextOutlines::Contour points;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            points.push_back(corners[i]);
            points.push_back(0.5f * (corners[i] + corners[(i + 1) % corners.size()]));
        }
        return points;
    };
    TextOutlines text;
    text.lines.push_back({1, 1, {{0, 0, {}}}});
    text.lines[0].letters[0].contours = {
        contour({{1, -0.5f}, {1, 0.5f}, {0.5f, 1}, {-0.5f, 1}, {-1, 0.5f}, {-1, -0.5f}, {-0.5f, -1}, {0.5f, -1}}),
        contour({{0.25f, -0.25f}, {-0.25f, -0.25f}, {-0.25f, 0.25f}, {0.25f, 0.25f}})};
    FromFile<TextOutlines> file;
    file.content = std::make_shared<const TextOutlines>(std::move(text));
    return file;
}

FromFile<HeightGrid> symmetric_grid() {
    FromFile<HeightGrid> file;
    file.content = std::make_shared<const HeightGrid>(HeightGrid{3, 3, {0, 0.5f, 0, 0.5f, 1, 0.5f, 0, 0.5f, 0}});
    return file;
}

Solids every_primitive() {
    Solids s;
    s.add(Sphere{.radius = 1});
    s.add(Box{.size = {1, 1, 1}});
    s.add(Box{.size = {2, 1, 0.5f}});
    s.add(RoundedBox{.size = {1, 1, 1}, .radius = 0.25f});
    s.add(Cylinder{.radius = 0.5f, .height = 1});
    s.add(CappedCone{.radius_bottom = 0.5f, .radius_top = 0.25f, .height = 1});
    s.add(CappedCone{.radius_bottom = 1, .radius_top = 0, .height = 1});
    s.add(Capsule{.from = {0, 0, -0.5f}, .to = {0, 0, 0.5f}, .radius = 0.25f});
    s.add(Torus{.major = 0.75f, .minor = 0.25f});
    s.add(Plane{.normal = {1, 1, 1}, .offset = 0});
    s.add(Ellipsoid{.radii = {1, 0.5f, 0.5f}});
    s.add(CappedTorus{.major = 1, .minor = 0.25f, .angle = 180});
    s.add(Link{.length = 1, .major = 0.5f, .minor = 0.25f});
    s.add(Tube{.radius = 1, .inner_radius = 0.5f, .height = 1});
    s.add(RoundedCylinder{.radius = 0.5f, .height = 1, .edge = 0.125f});
    s.add(RoundCone{.from = {0, 0, -0.5f}, .radius_from = 0.5f, .to = {0, 0, 0.5f}, .radius_to = 0.25f});
    s.add(SphericalCap{.radius = 1, .cut = 0});
    s.add(SphericalCap{.radius = 1, .cut = 0.5f});
    for (const float sides : {3.f, 4.f, 5.f, 6.f, 8.f}) s.add(Prism{.sides = sides, .radius = 1, .height = 1});
    s.add(Wedge{.size = {1, 1, 1}});
    s.add(Pyramid{.base = 1.25f, .height = 1.25f});
    s.add(Pyramid{.base = 1, .height = 0.5f});
    s.add(Octahedron{.radius = 1});
    s.add(Tetrahedron{.radius = 1});
    s.add(Gyroid{.period = 1, .thickness = 0.25f});
    s.add(SchwarzP{.period = 1, .thickness = 0.25f});
    s.add(SchwarzD{.period = 1, .thickness = 0.25f});
    s.add(Polyline{.points = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 1, 1}}, .radius = 0.25f});
    s.add(Polyhedron{.normals = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, .offsets = {0.5f}});
    s.add(VoronoiCells{.size = 0.5f, .gap = 0.125f, .jitter = 0});
    s.add(HeightMap{.file = symmetric_grid(), .size_x = 1, .size_y = 1, .height = 0.5f});
    s.add(Circle{.radius = 0.5f});
    s.add(Rectangle{.width = 1, .height = 1, .corner_radius = 0});
    s.add(Rectangle{.width = 1, .height = 0.5f, .corner_radius = 0.125f});
    for (const float points : {3.f, 4.f, 5.f, 6.f}) s.add(Star{.points = points, .radius = 1, .inner_radius = 0.375f});
    s.add(Slab{.normal = {1, -1, 0}, .offset = 0, .thickness = 0.5f});
    s.add(BoxFrame{.size = {1, 1, 1}, .thickness = 0.125f});
    s.add(Bowl{.radius = 1, .cut = 0, .thickness = 0.25f});
    s.add(Dodecahedron{.radius = 1});
    s.add(Icosahedron{.radius = 1});
    s.add(Balls{.centres = {{-0.25f, 0, 0}, {0.25f, 0, 0}, {0, 0.5f, 0}}, .radii = {0.25f}});
    s.add(Mesh{.file = held(octahedron_mesh())});
    s.add(Helix{.radius = 0.5f, .pitch = 0.5f, .turns = 2, .wire = 0.125f});
    s.add(Heightfield{.size = 1, .amplitude = 0.25f});
    s.add(Polygon{.points = {{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {0, 0.25f}, {-0.5f, 0.5f}}});
    s.add(Bezier{.points = {{-0.5f, 0}, {0, 1}, {0.5f, 0}}, .thickness = 0.25f});
    s.add(Text{.file = octagonal_letter(), .size = 0.5f});
    return s;
}

/// Solids of operators that select, blend, fold and bend.
void add_operators(Solids& s) {
    const auto at = [](float x, float y, float z, Field f) {
        return Field(warped(Translate{.by = {x, y, z}}, std::move(f)));
    };
    const Field ball = Sphere{.radius = 0.5f}, cube = Box{.size = {1, 1, 1}};
    const Field left = at(-0.25f, 0, 0, ball), right = at(0.25f, 0, 0, ball);
    s.add_made_of("union", Union{.of = {left, right}});
    s.add_made_of("smooth_union", SmoothUnion{.of = {left, right}, .radius = 0.5f});
    s.add_made_of("smooth_union of cubes",
                  SmoothUnion{.of = {at(-0.5f, -0.5f, 0, cube), at(0.5f, 0.5f, 0, cube)}, .radius = 0.5f});
    s.add_made_of("smooth_intersection", SmoothIntersection{.of = {left, right}, .radius = 0.25f});
    s.add_made_of("smooth_difference", SmoothDifference{.from = cube, .subtract = {left, right}, .radius = 0.25f});
    s.add_made_of("intersection", Intersection{.of = {left, right}});
    s.add_made_of("difference", Difference{.from = cube, .subtract = {ball}});
    s.add_made_of("shell", Shell{.of = Octahedron{.radius = 1}, .half_thickness = 0.125f});
    s.add_made_of("offset", Offset{.of = Tetrahedron{.radius = 1}, .amount = 0.125f});
    s.add_made_of("blob", Blob{.points = {{-0.25f, 0, 0}, {0.25f, 0, 0}}, .radii = {0.75f}});
    s.add_made_of("siren", Siren{.file = ball_like_network()});
    s.add_made_of("mirror", warped(Mirror{.normal = {1, 0, 0}}, at(0.25f, 0, 0, Octahedron{.radius = 0.5f})));
    for (const float rate : {45.f, -45.f})
        s.add_made_of("bend", warped(Bend{.rate = rate}, Field(Box{.size = {2, 1, 0.5f}})));
    s.add_made_of("twist", warped(Twist{.rate = 45}, Field(Octahedron{.radius = 1})));
    s.add_made_of("taper", warped(Taper{.rate = 0.25f}, Field(Pyramid{.base = 1, .height = 1})));
    s.add_made_of("stretch", warped(Stretch{.factors = {2, 1, 1}}, Field(Octahedron{.radius = 0.5f})));
}

/// Rays along the axes and the diagonals, through points of a lattice: coordinates are zero, equal and opposite, and
/// stay so along the ray.
template <class Ray>
void symmetric_rays(Random& rng, int count, Ray&& ray) {
    const std::array<float, 7> places{-0.5f, -0.25f, -0.125f, 0, 0.125f, 0.25f, 0.5f};
    const auto place = [&] { return places[static_cast<std::size_t>(rng.below(7))]; };
    for (int n = 0; n < count; ++n) {
        glm::vec3 target, along(0);
        for (int i = 0; i < 3; ++i) target[i] = place();
        if (rng.chance(0.5)) target.y = rng.chance(0.5) ? target.x : -target.x;
        if (rng.chance(0.3)) target.z = target.y;
        while (along == glm::vec3(0))
            for (int i = 0; i < 3; ++i) along[i] = static_cast<float>(rng.below(3) - 1);
        ray(target - 4.f * along, glm::vec3(glm::normalize(glm::dvec3(along))));
    }
}

}  // namespace

TEST_CASE("on symmetric points the normal is that of a face") {
    Solids solids = every_primitive();
    for_each_type(PlainFields(), [&]<class N>() {
        if constexpr (Primitive<N> || DataPrimitive<N>) {
            CAPTURE(N::info.name);
            CHECK(solids.names.contains(std::string(N::info.name)));
        }
    });
    add_operators(solids);
    const FlushSubnormals flush;
    NormalTotals all;
    Random rng(71);
    for (const Solid& solid : solids.list) {
        const Phased object = Set{.phase = Phase{1}, .of = solid.field};
        const InterfaceTracer tracer(object);
        symmetric_rays(rng, long_tests() ? 20'000 : 100, [&](const glm::vec3& o, const glm::vec3& d) {
            each_crossing(tracer, o, d, [&](const Crossing& c, const glm::vec3&) {
                const NormalCheck check{object, c, d, tracer.resolution(), tracer.normal(c, d)};
                REQUIRE(glm::dot(check.normal, check.direction) > 0);
                all.count(check, check.verdict_among_faces(), solid.name);
            });
        });
    }
    MESSAGE(all.right, " normals of a face, ", all.by_an_edge, " between two");
    INFO(all.complaints);
    CHECK(all.wrong == 0);
    CHECK(all.right > 5 * all.by_an_edge);
}

TEST_CASE("along jittered and grazing rays no normal is an outlier, whatever the node") {
    const FlushSubnormals flush;
    NormalTotals all;
    const int trees = long_tests() ? 60 : 3, rays = long_tests() ? 200 : 10;
    for (const NodeKind& kind : node_kinds()) {
        Random rng(72);
        for (int tree = 0; tree < trees; ++tree) {
            const auto object = traceable(kind.object(rng, 1 + tree % 3 + !kind.is_field));
            if (!object) continue;
            const InterfaceTracer tracer(*object);
            grazing_rays(*object, tracer, rng, rays, 4, [&](const glm::vec3& o, const glm::vec3& ray) {
                each_crossing(tracer, o, ray, [&](const Crossing& c, const glm::vec3& d) {
                    const NormalCheck check{*object, c, d, tracer.resolution(), tracer.normal(c, d)};
                    REQUIRE(glm::dot(check.normal, check.direction) > 0);
                    all.count(check, check.verdict(), kind.name);
                });
            });
        }
    }
    MESSAGE(all.right, " normals, ", all.by_an_edge, " more by edges");
    INFO(all.complaints);
    CHECK(all.wrong == 0);
    CHECK(all.right > (long_tests() ? 400'000 : 10'000));
    CHECK(all.right > 10 * all.by_an_edge);
}

TEST_CASE("a leaning cone's side, grazed, has one normal, though the field there is zero to rounding") {
    const FlushSubnormals flush;
    const Phased cone = leaning_cone();
    const InterfaceTracer tracer(cone);
    NormalTotals all;
    rays_at_leaning_cone(2000, [&](const glm::vec3& o, const glm::vec3& ray) {
        each_crossing(tracer, o, ray, [&](const Crossing& c, const glm::vec3& d) {
            const NormalCheck check{cone, c, d, tracer.resolution(), tracer.normal(c, d)};
            all.count(check, check.verdict(), "cone");
        });
    });
    INFO(all.complaints);
    CHECK(all.wrong == 0);
    CHECK(all.right == 4000);
}

TEST_CASE("a ray within rounding of a plane that it runs along has the plane's normal") {
    const FlushSubnormals flush;
    Random rng(74);
    std::size_t crossings = 0;
    for (int scene = 0; scene < 160; ++scene) {
        const Rotate turn{.axis = rng.direction(), .angle = rng.uniform(-180, 180)};
        const Phased object = Set{.phase = Phase{1}, .of = warped(turn, Field(Box{.size = {1, 1, 1}}))};
        const InterfaceTracer tracer(object);
        // The box's face that is nearest to some point inside.
        const glm::dvec3 inside(0.25f * rng.direction());
        const glm::vec3 n(direction_of_growth(object, inside, Phase{1}, 1e-9));
        const glm::vec3 along = glm::normalize(glm::cross(n, rng.direction()));
        for (int ray = 0; ray < 50; ++ray) {
            const glm::vec3 o = 0.5f * n + rng.uniform(-1e-6f, 1e-6f) * n - 0.4f * along;
            each_crossing(tracer, o, along, [&](const Crossing& c, const glm::vec3& d) {
                if (glm::length(c.p_from - 0.5f * n) > 0.45f) return;
                const glm::vec3 normal = tracer.normal(c, d);
                ++crossings;
                REQUIRE(std::abs(glm::dot(normal, n)) > 0.999f);
                REQUIRE(glm::dot(normal, d) > 0);
            });
        }
    }
    MESSAGE(crossings, " crossings");
    CHECK(crossings > 100);
}

TEST_CASE("dual numbers of equal values are those of one order") {
    const Dual a(2, 1, 0, 0), b(2, 0, 1, 0), zero(0.f), nothing(0, 0, 0, 1);
    CHECK(min(a, b).gradient() + max(a, b).gradient() == a.gradient() + b.gradient());
    CHECK((max(nothing, zero) + min(nothing, zero)).gradient() == nothing.gradient());
    CHECK(smooth_min(a, b, 1).gradient() == glm::vec3(0.5f, 0.5f, 0));
    CHECK(smooth_max(a, b, 1).gradient() == glm::vec3(0.5f, 0.5f, 0));
    for (const float x : {2.f, -2.f})
        for (const float y : {2.f, -2.f}) {
            const Dual angle = angle_of(Dual(x, 1, 0, 0), Dual(y, 0, 1, 0));
            CHECK(angle.value() == angle_of(x, y));
            CHECK(angle.gradient() == glm::vec3(-y / 8, x / 8, 0));
        }
}

}  // namespace test_normals
