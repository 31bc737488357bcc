#include "shading/interface.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "bsdf_checks.hpp"
#include "shading/frame.hpp"
#include "shading/metals.hpp"

namespace test_interface {

using namespace phasetree::tracer;
using phasetree::tests::direction;

namespace {

const Material glass = Clear{1.5f, Medium{}, 0.0f};
const Material ground_glass = Clear{1.5f, Medium{}, 0.2f};
const Material water = Clear{1.33f, Medium{}, 0.0f};
const Material sand = Diffuse{ConstantTexture{{0.5f, 0.4f, 0.3f}}};
const Material varnish = Coated{ConstantTexture{{0.5f, 0.4f, 0.3f}}, 1.5f, 0.0f};

Interface between(const Material& from, const Material& to) {
    SharedSurfaces shared;
    return Interface::between(from, to, shared);
}

// An interface together with its BSDF at the origin, which refers to it.
class Optics {
  public:
    Optics(const Material& from, const Material& to)
        : interface_(between(from, to)), bsdf_(interface_.at(glm::vec3{0.0f})) {}
    const Bsdf* operator->() const { return &bsdf_; }

  private:
    Interface interface_;
    Bsdf bsdf_;
};

Optics optics(const Material& from, const Material& to) {
    return Optics(from, to);
}

}  // namespace

TEST_CASE("interface: clear materials refract by the ratio of their indices, without a gap") {
    const auto sample = optics(glass, water)->sample(direction(30.0), 0.999999f, {});
    REQUIRE(sample);
    REQUIRE(sample->transmitted);
    CHECK(glm::length(glm::vec2{sample->wi}) == doctest::Approx(0.5 * 1.5 / 1.33));
    CHECK(sample->weight.x == doctest::Approx((1.5 / 1.33) * (1.5 / 1.33)));
    // With an air gap, light at 50° would be totally reflected; here it is not.
    CHECK(optics(glass, water)->sample(direction(50.0), 0.999999f, {})->transmitted);
    CHECK_FALSE(optics(glass, vacuum())->sample(direction(50.0), 0.999999f, {})->transmitted);
}

TEST_CASE("interface: equal indices pass through, rough or not") {
    CHECK(optics(glass, glass)->passes_through());
    CHECK(optics(glass, ground_glass)->passes_through());
    CHECK(optics(vacuum(), vacuum())->passes_through());
    CHECK_FALSE(optics(glass, water)->passes_through());
}

TEST_CASE("interface: the rougher of two clear materials decides") {
    CHECK(optics(vacuum(), glass)->is_delta());
    CHECK_FALSE(optics(vacuum(), ground_glass)->is_delta());
    CHECK_FALSE(optics(ground_glass, vacuum())->is_delta());
    CHECK_FALSE(optics(ground_glass, water)->is_delta());
}

TEST_CASE("interface: metal in water differs from metal in air") {
    const Metal gold = *find_metal("gold");
    const Material metal = Conductor{gold.eta, gold.k, 0.0f};
    const glm::vec3 wo = direction(0.0);
    const auto in_air = optics(vacuum(), metal)->sample(wo, 0.5f, {});
    const auto in_water = optics(water, metal)->sample(wo, 0.5f, {});
    REQUIRE(in_air);
    REQUIRE(in_water);
    CHECK(in_air->weight == fresnel_conductor(1.0f, gold.eta, gold.k));
    CHECK(in_water->weight == fresnel_conductor(1.0f, gold.eta / 1.33f, gold.k / 1.33f));
    CHECK(in_water->weight.y < in_air->weight.y);
}

TEST_CASE("interface: varnish reflects less in water and not at all in glass of its own index") {
    const glm::vec3 wo = direction(0.0);
    const auto mirror = [&](const Material& from) {
        const auto sample = optics(from, varnish)->sample(wo, 0.0f, {0.3f, 0.3f});
        return sample && sample->delta ? static_cast<double>(sample->weight.x * sample->pdf) : 0.0;
    };
    CHECK(mirror(vacuum()) == doctest::Approx(0.04));
    CHECK(mirror(water) == doctest::Approx(0.0036).epsilon(0.01));
    CHECK(mirror(glass) == 0.0);
}

TEST_CASE("interface: opaque surfaces take their colour from the texture at the point") {
    const Material checker = Diffuse{CheckerTexture{glm::vec3{0.9f}, glm::vec3{0.1f}, 1.0f, glm::vec3{0.0f}}};
    const Interface interface = between(water, checker);
    const glm::vec3 w = direction(10.0);
    CHECK(interface.at(glm::vec3{0.5f, 0.5f, 0.5f}).evaluate(w, w).x == doctest::Approx(0.9f * w.z / pi));
    CHECK(interface.at(glm::vec3{1.5f, 0.5f, 0.5f}).evaluate(w, w).x == doctest::Approx(0.1f * w.z / pi));
}

TEST_CASE("interface: nothing comes out of opaque materials") {
    const glm::vec3 w = direction(10.0);
    CHECK(optics(sand, vacuum())->evaluate(w, w) == glm::vec3{0.0f});
    CHECK(optics(varnish, sand)->evaluate(w, w) == glm::vec3{0.0f});
}

TEST_CASE("interface table: the same as pair by pair, and a wrong index is an error") {
    const std::vector<Material> materials{vacuum(), glass, water, sand, varnish};
    SharedSurfaces shared;
    const InterfaceTable table(materials, shared);
    const glm::vec3 wo = direction(35.0);
    for (std::size_t from = 0; from < materials.size(); ++from) {
        for (std::size_t to = 0; to < materials.size(); ++to) {
            const auto a = table.between(from, to).at(glm::vec3{0.1f}).sample(wo, 0.6f, {0.2f, 0.7f});
            const auto b = optics(materials[from], materials[to])->sample(wo, 0.6f, {0.2f, 0.7f});
            REQUIRE(a.has_value() == b.has_value());
            if (!a) continue;
            CHECK(a->wi == b->wi);
            CHECK(a->weight == b->weight);
        }
    }
    CHECK_THROWS_AS(table.between(5, 0), std::out_of_range);
    CHECK_THROWS_AS(table.between(0, 5), std::out_of_range);
}

TEST_CASE("frame: orthonormal, and there and back") {
    phasetree::tests::Uniform uniform(51);
    for (int i = 0; i < 1000; ++i) {
        const float first = uniform();
        const glm::vec3 n = square_to_uniform_sphere({first, uniform()});
        const Frame frame(n);
        CHECK(glm::length(frame.to_local(n) - glm::vec3{0.0f, 0.0f, 1.0f}) < 1e-6f);
        const glm::vec3 w = direction(70.0);
        CHECK(glm::length(frame.to_local(frame.to_world(w)) - w) < 1e-6f);
    }
    CHECK(Frame({0.0f, 0.0f, -1.0f}).to_world({0.0f, 0.0f, 1.0f}).z == -1.0f);
}

}  // namespace test_interface
