// The contracts of lights, BSDFs, textures, media and cameras: they accept types that belong to a kind, and reject
// others. Each list of kinds asserts itself that all of its kinds meet their contract.
#include <doctest/doctest.h>

#include "camera/camera.hpp"
#include "lights/kinds.hpp"
#include "media/medium.hpp"
#include "shading/bsdf.hpp"
#include "shading/texture/texture.hpp"

namespace test_contracts {

using namespace phasetree::tracer;

namespace {

// A kind of each sort in which one member is wrong.
struct InfiniteWithoutCentre {
    glm::vec3 radiance(const glm::vec3&) const;
    std::optional<DirectionSample> sample(const glm::vec2&) const;
    float pdf(const glm::vec3&) const;
    float fluence() const;
};
struct TextureOfFloats {
    float at(const glm::vec3&) const;
};
struct MediumThatChanges {
    glm::vec3 transmittance(float);
};

static_assert(InfiniteLightKind<Sun> && !InfiniteLightKind<RectangleLight>);
static_assert(!InfiniteLightKind<InfiniteWithoutCentre>);
static_assert(AreaLightKind<SphereLight> && !AreaLightKind<Sun>);
static_assert(BsdfKind<CoatedDiffuseBsdf> && BsdfKind<Bsdf> && !BsdfKind<ConstantTexture>);
static_assert(TextureKind<WoodTexture> && !TextureKind<TextureOfFloats>);
static_assert(MediumKind<AbsorbingMedium> && !MediumKind<MediumThatChanges>);
static_assert(CameraKind<ThinLens> && CameraKind<Orthographic> && !CameraKind<Camera>);

}  // namespace

TEST_CASE("a medium by its kind and by any kind lets the same through") {
    const AbsorbingMedium medium{glm::vec3(0.5f, 0, 3)};
    const Way way{glm::vec3(0), glm::vec3(0, 0, 1), 0.7f};
    const Way endless{glm::vec3(0), glm::vec3(0, 0, 1), std::numeric_limits<float>::infinity()};
    Sampler sampler(0, 0, 0, 0);
    CHECK(transmittance(Medium(medium), way, sampler) == medium.transmittance(way, sampler));
    CHECK(transmittance(Medium(), endless, sampler) == glm::vec3(1));
}

}  // namespace test_contracts
