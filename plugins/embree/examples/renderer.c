/* A renderer that handles phases. Rays carry their phases, pass straight through glass and water, which tint them, and
 * stop at everything else. A filter function hides the sand from both camera and shadow rays.
 *
 *   renderer IMAGE.ppm
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene.h"

enum { WIDTH = 480, HEIGHT = 320, MAX_CROSSINGS = 64 };

static const float sun[3] = {0.41f, -0.62f, 0.67f};

/* Colours of phases, and the fraction of light that one unit of length transmits; 0 for opaque phases. */
static const struct {
    float color[3], clear[3];
} materials[] = {{{0, 0, 0}, {1, 1, 1}},
                 {{0, 0, 0}, {0.55f, 0.8f, 0.6f}},
                 {{0, 0, 0}, {0.45f, 0.7f, 0.95f}},
                 {{0.75f, 0.45f, 0.25f}, {0, 0, 0}},
                 {{0.7f, 0.6f, 0.4f}, {0, 0, 0}}};

static int occluded(RTCScene scene, const float origin[3], PhasetreeRay* state) {
    PhasetreeRayContext context;
    struct RTCRay ray;
    memset(&ray, 0, sizeof ray);
    ray.org_x = origin[0], ray.org_y = origin[1], ray.org_z = origin[2];
    ray.dir_x = sun[0], ray.dir_y = sun[1], ray.dir_z = sun[2];
    ray.tnear = 1e-3f, ray.tfar = INFINITY, ray.mask = ~0u;
    phasetreeInitRayContext(&context);
    context.rays = state, context.rayCount = 1;
#if RTC_VERSION_MAJOR >= 4
    struct RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context.context;
    rtcOccluded1(scene, &ray, &arguments);
#else
    rtcOccluded1(scene, &context.context, &ray);
#endif
    return ray.tfar < 0;
}

static void intersect(RTCScene scene, struct RTCRayHit* ray, PhasetreeRay* state) {
    PhasetreeRayContext context;
    phasetreeInitRayContext(&context);
    context.rays = state, context.rayCount = 1;
#if RTC_VERSION_MAJOR >= 4
    struct RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context.context;
    rtcIntersect1(scene, ray, &arguments);
#else
    rtcIntersect1(scene, &context.context, ray);
#endif
}

static void trace(const Scene* scene, struct RTCRayHit ray, float rgb[3]) {
    /* The phase of each instance that the ray is in. */
    PhasetreeCarriedPhase carried[2];
    PhasetreeRay state;
    const unsigned int instances[2] = {FIRST, SECOND};
    float light[3] = {1, 1, 1};
    memset(&state, 0, sizeof state);
    state.carried = carried, state.carriedCount = 2;
    for (int i = 0; i < 2; ++i) {
        carried[i].geomID = 0, carried[i].instID = instances[i], carried[i].phase = PHASETREE_VACUUM;
#if RTC_VERSION_MAJOR >= 4
        carried[i].instPrimID = 0;
#endif
    }
    for (int crossing = 0; crossing < MAX_CROSSINGS; ++crossing) {
        const float before = ray.ray.tnear;
        float normal[3] = {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}, color[3], point[3];
        ray.ray.tfar = INFINITY;
        ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        intersect(scene->outer, &ray, &state);
        const float end = ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? before : ray.ray.tfar;
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 2; ++i) light[k] *= powf(materials[carried[i].phase].clear[k], end - before);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            const float sky[3] = {0.65f, 0.75f, 0.9f};
            for (int k = 0; k < 3; ++k) rgb[k] = light[k] * sky[k];
            return;
        }
        const float origin[3] = {ray.ray.org_x, ray.ray.org_y, ray.ray.org_z};
        const float direction[3] = {ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z};
        for (int k = 0; k < 3; ++k) point[k] = origin[k] + end * direction[k];
        const float flat[3] = {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z};
        if (ray.hit.instID[0] == RTC_INVALID_GEOMETRY_ID) {
            const int odd = ((int)floorf(2 * point[0]) + (int)floorf(2 * point[1])) & 1;
            color[0] = color[1] = color[2] = odd ? 0.5f : 0.7f;
            normal[0] = 0, normal[1] = 0, normal[2] = 1;
        } else {
            PhasetreeCarriedPhase* const current = carried + (ray.hit.instID[0] == FIRST ? 0 : 1);
            const unsigned int entered = state.hit.to;
            if (materials[entered].clear[0] > 0) { /* continue in that phase, from the bracket's far end */
                current->phase = entered;
                ray.ray.tnear = state.hit.tTo;
                continue;
            }
            memcpy(color, materials[entered].color, sizeof color);
            normalToWorld(scene->objectToWorld[ray.hit.instID[0]], flat, normal);
        }
        const float cosine = normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2];
        const float lit = cosine > 0 && !occluded(scene->outer, point, &state) ? cosine : 0;
        for (int k = 0; k < 3; ++k) rgb[k] = light[k] * color[k] * (0.3f + 0.8f * lit);
        return;
    }
}

int main(int argc, char** argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s IMAGE.ppm\n", argv[0]);
        return 2;
    }
    RTCDevice device = rtcNewDevice(NULL);
    Scene scene = makeScene(device, PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT, "sand");
    float* image = calloc(3 * WIDTH * HEIGHT, sizeof *image);
    if (!image) return 1;
    for (int y = 0; y < HEIGHT; ++y)
        for (int x = 0; x < WIDTH; ++x) trace(&scene, cameraRay(x, y, WIDTH, HEIGHT), image + 3 * (y * WIDTH + x));
    writeImage(argv[1], image, WIDTH, HEIGHT);
    free(image);
    releaseScene(&scene);
    rtcReleaseDevice(device);
    return 0;
}
