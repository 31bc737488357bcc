/* The scene of both renderers: a floor of triangles, and two instances of one tree, one mirrored and smaller. */
#ifndef SCENE_H
#define SCENE_H

#include <phasetree/phasetree_embree.h>

enum { FLOOR = 0, FIRST = 1, SECOND = 2 }; /* geomIDs of the outer scene; the tree is geometry 0 of the inner one */

typedef struct Scene {
    RTCScene outer, inner;
    PhasetreeTree tree;
    PhasetreeGeometry object;
    float objectToWorld[3][12]; /* by geomID */
} Scene;

/* Ends the program with the library's message if a call has failed. */
void check(PhasetreeError error);

/* flags: those of the tree's geometry. hidden: the name of a phase that a filter function hides, or NULL. */
Scene makeScene(RTCDevice device, unsigned int flags, const char* hidden);
void releaseScene(Scene* scene);

/* The ray of a pinhole camera through a pixel of an image of width × height. */
struct RTCRayHit cameraRay(int x, int y, int width, int height);
/* Transforms a normal from object space to the world, and normalises it. */
void normalToWorld(const float* objectToWorld, const float normal[3], float world[3]);
/* Writes a PPM file from linear colours in [0, 1]. */
void writeImage(const char* path, const float* rgb, int width, int height);

#endif
