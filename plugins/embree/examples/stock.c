/* The same scene in a host that does not know about phases. It sees geometries with hits, IDs and normals, and passes
 * Embree's standard context. Nothing is hidden: the sand is visible.
 *
 *   stock IMAGE.ppm
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene.h"

enum { WIDTH = 480, HEIGHT = 320 };

/* Everything up to main() is the host, which has the scene and one matrix per instance. */
static void trace(RTCScene scene, float objectToWorld[][12], struct RTCRayHit ray, float rgb[3]) {
    static const float sun[3] = {0.41f, -0.62f, 0.67f};
    static const float colors[3][3] = {{0.6f, 0.6f, 0.6f}, {0.7f, 0.35f, 0.3f}, {0.3f, 0.45f, 0.7f}};
#if RTC_VERSION_MAJOR < 4
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#else
    rtcIntersect1(scene, &ray, NULL);
#endif
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        rgb[0] = 0.65f, rgb[1] = 0.75f, rgb[2] = 0.9f;
        return;
    }
    const float flat[3] = {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z};
    float normal[3] = {0, 0, 1};
    unsigned int id = ray.hit.geomID;
    if (ray.hit.instID[0] != RTC_INVALID_GEOMETRY_ID) {
        id = ray.hit.instID[0];
        normalToWorld(objectToWorld[id], flat, normal);
    }
    struct RTCRay shadow = ray.ray;
    shadow.org_x += ray.ray.tfar * ray.ray.dir_x + 1e-3f * normal[0];
    shadow.org_y += ray.ray.tfar * ray.ray.dir_y + 1e-3f * normal[1];
    shadow.org_z += ray.ray.tfar * ray.ray.dir_z + 1e-3f * normal[2];
    shadow.dir_x = sun[0], shadow.dir_y = sun[1], shadow.dir_z = sun[2];
    shadow.tnear = 0, shadow.tfar = INFINITY;
#if RTC_VERSION_MAJOR < 4
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &shadow);
#else
    rtcOccluded1(scene, &shadow, NULL);
#endif
    const float cosine = normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2];
    const float lit = shadow.tfar < 0 ? 0 : fmaxf(cosine, 0);
    for (int k = 0; k < 3; ++k) rgb[k] = colors[id][k] * (0.3f + 0.8f * lit);
}

int main(int argc, char** argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s IMAGE.ppm\n", argv[0]);
        return 2;
    }
    RTCDevice device = rtcNewDevice(NULL);
    Scene scene = makeScene(device, PHASETREE_GEOMETRY_FLAG_NONE, NULL);
    float* image = calloc(3 * WIDTH * HEIGHT, sizeof *image);
    if (!image) return 1;
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x)
            trace(scene.outer, scene.objectToWorld, cameraRay(x, y, WIDTH, HEIGHT), image + 3 * (y * WIDTH + x));
    writeImage(argv[1], image, WIDTH, HEIGHT);
    free(image);
    releaseScene(&scene);
    rtcReleaseDevice(device);
    return 0;
}
