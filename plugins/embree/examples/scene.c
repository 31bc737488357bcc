#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A glass ball, half full of water, on a block of sand, with a metal rod through it. */
static const char* const text =
    "{\"phases\": {\"glass\": 0, \"water\": 0, \"metal\": 0, \"sand\": 0},"
    " \"tree\": {\"under\": ["
    "  {\"intersect_shape\": {\"phases\": \"water\", \"shape\": {\"plane\": {\"normal\": [0.1, 0, 1], \"offset\": "
    "0.1}}, \"of\":"
    "   {\"thin_shell\": {\"of\": {\"sphere\": {\"radius\": 0.9}}, \"shell\": \"glass\", \"inside\": \"water\","
    "    \"half_thickness\": 0.05}}}},"
    "  {\"set\": {\"phase\": \"metal\", \"of\": {\"rotate\": {\"axis\": [1, 0, 0], \"angle\": 25, \"of\":"
    "   {\"cylinder\": {\"radius\": 0.15, \"height\": 2.6}}}}}},"
    "  {\"set\": {\"phase\": \"sand\", \"of\": {\"translate\": {\"by\": [0, 0, -1.1], \"of\":"
    "   {\"rounded_box\": {\"size\": [2, 1.5, 0.4], \"radius\": 0.1}}}}}}]}}";

void check(PhasetreeError error) {
    if (error == PHASETREE_ERROR_NONE) return;
    fprintf(stderr, "%s\n", phasetreeGetErrorMessage());
    exit(1);
}

/* Called for each crossing. Rejects those into and out of the phase that the user pointer names. */
static void hide(const struct RTCFilterFunctionNArguments* args) {
    const unsigned int hidden = *(const unsigned int*)args->geometryUserPtr;
    for (unsigned int i = 0; i < args->N; ++i)
        if (args->valid[i] == -1 && (phasetreeGetHitFrom(args->hit, args->N, i) == hidden ||
                                     phasetreeGetHitTo(args->hit, args->N, i) == hidden))
            args->valid[i] = 0;
}

static void addInstance(RTCDevice device, Scene* scene, unsigned int id, const float matrix[12]) {
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, scene->inner);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(scene->outer, instance, id);
    rtcReleaseGeometry(instance);
    memcpy(scene->objectToWorld[id], matrix, sizeof scene->objectToWorld[id]);
}

static void addFloor(RTCDevice device, RTCScene scene) {
    const float vertices[12] = {-9, -9, -1.3f, 9, -9, -1.3f, 9, 9, -1.3f, -9, 9, -1.3f};
    const unsigned int triangles[6] = {0, 1, 2, 0, 2, 3};
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    memcpy(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4), vertices,
           sizeof vertices);
    memcpy(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 2), triangles,
           sizeof triangles);
    rtcCommitGeometry(mesh);
    rtcAttachGeometryByID(scene, mesh, FLOOR);
    rtcReleaseGeometry(mesh);
}

Scene makeScene(RTCDevice device, unsigned int flags, const char* hidden) {
    Scene scene;
    RTCGeometry geometry;
    PhasetreeGeometryOptions options;
    static unsigned int hiddenPhase;

    memset(&scene, 0, sizeof scene);
    phasetreeInitGeometryOptions(&options);
    options.flags = flags;
    check(phasetreeNewTreeFromText(PHASETREE_API_VERSION, text, strlen(text), "example", NULL, &scene.tree));
    check(phasetreeNewGeometry(PHASETREE_API_VERSION, device, scene.tree, &options, &scene.object));
    check(phasetreeGetEmbreeGeometry(scene.object, &geometry));
    if (hidden) {
        check(phasetreeGetTreePhaseByName(scene.tree, hidden, &hiddenPhase));
        check(phasetreeSetGeometryUserData(scene.object, &hiddenPhase));
        rtcSetGeometryIntersectFilterFunction(geometry, hide);
        rtcSetGeometryOccludedFilterFunction(geometry, hide);
    }
    scene.inner = rtcNewScene(device);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene.inner, geometry, 0);
    rtcCommitScene(scene.inner);

    scene.outer = rtcNewScene(device);
    addFloor(device, scene.outer);
    addInstance(device, &scene, FIRST, (const float[12]){1, 0, 0, 0, 1, 0, 0, 0, 1, -1.3f, 0, 0});
    addInstance(device, &scene, SECOND, (const float[12]){0, 0.7f, 0, 0.7f, 0, 0, 0, 0, 0.7f, 1.2f, -0.4f, -0.39f});
    rtcCommitScene(scene.outer);
    return scene;
}

void releaseScene(Scene* scene) {
    rtcReleaseScene(scene->outer);
    rtcReleaseScene(scene->inner);
    check(phasetreeReleaseGeometry(scene->object)); /* after the scenes */
    check(phasetreeReleaseTree(scene->tree));
}

struct RTCRayHit cameraRay(int x, int y, int width, int height) {
    struct RTCRayHit r;
    const float u = 0.55f * (2 * (x + 0.5f) - width) / height, v = 0.55f * (height - 2 * (y + 0.5f)) / height;
    memset(&r, 0, sizeof r);
    /* From (0, −5.6, 1.2), looking slightly downwards. */
    r.ray.org_y = -5.6f, r.ray.org_z = 1.2f;
    r.ray.dir_x = u, r.ray.dir_y = 1 + 0.28f * v, r.ray.dir_z = v - 0.28f;
    r.ray.tfar = INFINITY, r.ray.mask = ~0u;
    r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return r;
}

void normalToWorld(const float* m, const float n[3], float world[3]) {
    /* The cofactor matrix; its sign follows the determinant's. */
    float length = 0, determinant = 0;
    for (int i = 0; i < 3; ++i) {
        const float *a = m + 3 * ((i + 1) % 3), *b = m + 3 * ((i + 2) % 3);
        const float cofactor[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        if (i == 0) world[0] = world[1] = world[2] = 0;
        for (int k = 0; k < 3; ++k) world[k] += cofactor[k] * n[i];
        if (i == 0) determinant = cofactor[0] * m[0] + cofactor[1] * m[1] + cofactor[2] * m[2];
    }
    for (int k = 0; k < 3; ++k) length += world[k] * world[k];
    length = copysignf(sqrtf(length), determinant);
    for (int k = 0; k < 3; ++k) world[k] /= length;
}

void writeImage(const char* path, const float* rgb, int width, int height) {
    FILE* file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(1);
    }
    fprintf(file, "P6\n%d %d\n255\n", width, height);
    for (int i = 0; i < 3 * width * height; ++i)
        fputc((int)(255 * powf(fminf(fmaxf(rgb[i], 0), 1), 1 / 2.2f) + 0.5f), file);
    if (fclose(file) != 0) {
        perror(path);
        exit(1);
    }
}
