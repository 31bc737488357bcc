// A small Embree renderer. The tutorial "Phases in an Embree renderer" of the manual develops it step by step.
//
//   small_renderer SCENE.json IMAGE.ppm
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <phasetree/phasetree_embree.hpp>
#include <string>
#include <vector>

constexpr int width = 320, height = 320;

using Color = std::array<float, 3>;

struct Material {
    Color color;
    bool is_clear;
};

struct World {
    phasetree::embree::Tree tree;
    phasetree::embree::Geometry object;
    std::vector<Material> materials;  // by phase
    unsigned object_id = 0;
    RTCScene scene = nullptr;
};

void add_floor(RTCDevice device, RTCScene scene) {
    const float corners[] = {-50, -50, -1.23f, 50, -50, -1.23f, 50, 50, -1.23f, -50, 50, -1.23f};
    const unsigned triangles[] = {0, 1, 2, 0, 2, 3};
    RTCGeometry floor = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    std::memcpy(rtcSetNewGeometryBuffer(floor, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4), corners,
                sizeof corners);
    std::memcpy(rtcSetNewGeometryBuffer(floor, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 2), triangles,
                sizeof triangles);
    rtcCommitGeometry(floor);
    rtcAttachGeometry(scene, floor);
    rtcReleaseGeometry(floor);
}

std::vector<Material> materials_of(const phasetree::embree::Tree& tree) {
    std::vector<Material> materials;
    for (unsigned phase = 0; phase < tree.phase_count(); ++phase) {
        const std::string name = tree.phase_name(phase);
        materials.push_back(name == "sand"    ? Material{{0.85f, 0.65f, 0.4f}, false}
                            : name == "wood"  ? Material{{0.35f, 0.17f, 0.08f}, false}
                            : name == "brass" ? Material{{0.8f, 0.62f, 0.25f}, false}
                                              : Material{{0.75f, 0.9f, 0.85f}, true});
    }
    return materials;
}

World make_world(RTCDevice device, const char* path) {
    const auto tree = phasetree::embree::Tree::from_file(path);
    World world{tree, phasetree::embree::Geometry(device, tree), materials_of(tree)};
    world.scene = rtcNewScene(device);
    add_floor(device, world.scene);
    rtcCommitGeometry(world.object.embree());
    world.object_id = rtcAttachGeometry(world.scene, world.object.embree());
    rtcCommitScene(world.scene);
    return world;
}

RTCRayHit camera_ray(int x, int y) {
    RTCRayHit ray{};
    ray.ray.org_y = -6.5f, ray.ray.org_z = 1.3f;
    ray.ray.dir_x = 0.25f * (2 * x + 1 - width) / height;
    ray.ray.dir_y = 1;
    ray.ray.dir_z = 0.25f * (height - 2 * y - 1) / height - 0.2f;
    ray.ray.mask = ~0u;
    return ray;
}

// Finds the first hit after tnear.
bool intersect(RTCScene scene, RTCRayHit& ray) {
    ray.ray.tfar = INFINITY;
    ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
    return ray.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

// A surface of this colour in the light of a lamp and a bright sky.
Color shade(const RTCHit& hit, const Color& color) {
    const float length = std::hypot(hit.Ng_x, hit.Ng_y, hit.Ng_z);
    const float cosine = (-0.5f * hit.Ng_x - 0.6f * hit.Ng_y + 0.62f * hit.Ng_z) / length;
    const float light = 0.3f + 0.7f * std::fmax(cosine, 0.0f);
    return {light * color[0], light * color[1], light * color[2]};
}

Color trace(const World& world, RTCRayHit ray) {
    float light = 1;
    for (int crossing = 0; crossing < 64; ++crossing) {
        if (!intersect(world.scene, ray)) return {0.65f * light, 0.75f * light, 0.9f * light};
        if (ray.hit.geomID != world.object_id) return shade(ray.hit, {0.6f * light, 0.6f * light, 0.6f * light});
        const auto entered = static_cast<unsigned>(ray.hit.v);
        const Material& material = world.materials[entered];
        const Color color{light * material.color[0], light * material.color[1], light * material.color[2]};
        if (!material.is_clear) return shade(ray.hit, color);
        // Less light passes at grazing angles.
        const float length = std::hypot(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z) *
                             std::hypot(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z);
        const float cosine =
            (ray.hit.Ng_x * ray.ray.dir_x + ray.hit.Ng_y * ray.ray.dir_y + ray.hit.Ng_z * ray.ray.dir_z) / length;
        light *= 1 - 0.5f * std::pow(1 - std::fabs(cosine), 3.0f);
        ray.ray.tnear = world.object.decode(ray).tTo;
    }
    return {};
}

void render(const World& world, std::FILE* file) {
    std::fprintf(file, "P6\n%d %d\n255\n", width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const float c : trace(world, camera_ray(x, y)))
                std::fputc(static_cast<int>(255 * std::pow(std::fmin(c, 1.0f), 1 / 2.2f)), file);
}

int main(int argc, char** argv) {
    if (argc != 3) return std::fprintf(stderr, "usage: %s SCENE.json IMAGE.ppm\n", argv[0]), 2;
    std::FILE* file = std::fopen(argv[2], "wb");
    if (!file) return std::perror(argv[2]), 1;
    RTCDevice device = rtcNewDevice(nullptr);
    try {
        const World world = make_world(device, argv[1]);
        render(world, file);
        rtcReleaseScene(world.scene);
    } catch (const phasetree::embree::Error& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
    rtcReleaseDevice(device);
    return std::fclose(file) == 0 ? 0 : 1;
}
