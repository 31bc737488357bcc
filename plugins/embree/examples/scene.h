/* The scene of both renderers: a floor of triangles, and one tree twice, as instances, once mirrored and smaller. */
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

/* flags: of the tree's geometry. hidden: the name of a phase that a filter function hides, or NULL. */
Scene makeScene(RTCDevice device, unsigned int flags, const char* hidden);
void releaseScene(Scene* scene);

/* A pinhole camera's ray through a pixel of an image of width × height. */
struct RTCRayHit cameraRay(int x, int y, int width, int height);
/* A direction of the object's space into the world as normals go, and of unit length. */
void normalToWorld(const float* objectToWorld, const float normal[3], float world[3]);
/* Writes a PPM; colours from 0 to 1, linear. */
void writeImage(const char* path, const float* rgb, int width, int height);

#endif
