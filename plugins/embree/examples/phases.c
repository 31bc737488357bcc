/* Loads a scene's tree and prints every phase that one ray goes through.
 *
 *   phases SCENE.json [OX OY OZ DX DY DZ]
 */
#include <math.h>
#include <phasetree/phasetree_embree.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program with the library's message if a call has failed. */
static void check(PhasetreeError error) {
    if (error == PHASETREE_ERROR_NONE) return;
    fprintf(stderr, "%s\n", phasetreeGetErrorMessage());
    exit(1);
}

int main(int argc, char** argv) {
    if (argc != 2 && argc != 8) {
        fprintf(stderr, "usage: %s SCENE.json [OX OY OZ DX DY DZ]\n", argv[0]);
        return 2;
    }
    RTCDevice device = rtcNewDevice(NULL);
    PhasetreeTree tree;
    PhasetreeGeometry geometry;
    RTCGeometry embreeGeometry;
    check(phasetreeNewTreeFromFile(PHASETREE_API_VERSION, argv[1], NULL, &tree));
    check(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree, NULL, &geometry));
    check(phasetreeGetEmbreeGeometry(geometry, &embreeGeometry));

    RTCScene scene = rtcNewScene(device);
    rtcCommitGeometry(embreeGeometry);
    rtcAttachGeometry(scene, embreeGeometry);
    rtcCommitScene(scene);

    float ray[6] = {-1000, 0.01f, 0.02f, 1, 0, 0};
    for (int i = 2; i < argc; ++i) ray[i - 2] = strtof(argv[i], NULL);
    for (float start = 0;;) {
        struct RTCRayHit r = {0};
        r.ray.org_x = ray[0], r.ray.org_y = ray[1], r.ray.org_z = ray[2];
        r.ray.dir_x = ray[3], r.ray.dir_y = ray[4], r.ray.dir_z = ray[5];
        r.ray.tnear = start, r.ray.tfar = INFINITY, r.ray.mask = ~0u;
        r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene, &r, NULL);
#else
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &r);
#endif
        if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
        PhasetreeHit hit;
        const char *from, *to;
        check(phasetreeDecodeHit(geometry, &r, NULL, &hit));
        check(phasetreeGetTreePhaseName(tree, hit.from, &from));
        check(phasetreeGetTreePhaseName(tree, hit.to, &to));
        printf("%.5f  %s -> %s\n", hit.tFrom, from, to);
        start = fmaxf(hit.tTo, nextafterf(hit.tFrom, INFINITY));
    }
    rtcReleaseScene(scene);
    check(phasetreeReleaseGeometry(geometry));
    check(phasetreeReleaseTree(tree));
    rtcReleaseDevice(device);
    return 0;
}
