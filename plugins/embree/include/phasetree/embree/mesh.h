/* Meshes: the interfaces of a geometry as triangles, for rasterised viewports or other programs. See phasetree_embree.h
 * for the conventions. */
#ifndef PHASETREE_EMBREE_MESH_H
#define PHASETREE_EMBREE_MESH_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* Options of phasetreeMakeGeometryMesh. Initialise them with phasetreeInitMeshOptions. */
typedef struct PhasetreeMeshOptions {
    /* Distance between grid points, about the size of the smallest detail kept. 0 selects a 256th of the longest side
     * of the object's bounds; the minimum is a 1024th. */
    float spacing;
    /* Polled from any thread; return true to cancel with PHASETREE_ERROR_CANCELLED. May be NULL. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
    /* Receives the fraction done, in (0, 1]; called by one thread at a time. May be NULL. */
    void (*progress)(float done, void* userPtr);
    void* progressUserPtr;
} PhasetreeMeshOptions;

/* Sets the defaults. */
static inline void phasetreeInitMeshOptions(PhasetreeMeshOptions* options) {
    options->spacing = 0;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
    options->progress = NULL;
    options->progressUserPtr = NULL;
}

/* The interfaces between phases as triangles. Each triangle appears once, and neighbours share vertices, so the
 * triangles with a given phase on exactly one side form that phase's closed, manifold surface. */
typedef struct PhasetreeMesh {
    const float* vertices;       /* 3 · vertexCount coordinates in the tree's own space */
    const unsigned int* indices; /* 3 · triangleCount; counterclockwise as seen from the front phase */
    const unsigned char* behind; /* triangleCount phases: the one with the higher index */
    const unsigned char* front;  /* triangleCount phases: the one with the lower index; 0 is the vacuum */
    size_t vertexCount, triangleCount;
    float spacing; /* the spacing used */
    /* The number of crossings along the grid's lines, and how many of them are missing from the mesh. They are missing
     * at edges of the object, and where a phase is thinner than the spacing. */
    size_t crossings, skipped;
} PhasetreeMesh;

/* Meshes the interfaces of a geometry by tracing rays through its cells. phasetree/meshing/phase_mesh.hpp describes the
 * method.
 *
 * options  NULL for the defaults.
 * receive  called once with the mesh, on the calling thread, if there is no error. The arrays belong to the library and
 *          are valid only during the call. Must not throw.
 * userPtr  passed to receive.
 *
 * The mesh contains all phases, shown or hidden, in the tree's own space regardless of motion. Uses the threads of
 * TBB's default arena; the result does not depend on their number. With the default spacing it takes about a second.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT   the spacing is negative or not finite, or too small for the bounds
 * PHASETREE_ERROR_INVALID_OPERATION  the geometry was built with opaque phases, inside which interfaces are unknown
 * PHASETREE_ERROR_CANCELLED          options->cancelled returned true */
PHASETREE_API PhasetreeError phasetreeMakeGeometryMesh(PhasetreeGeometry geometry, const PhasetreeMeshOptions* options,
                                                       void (*receive)(const PhasetreeMesh* mesh, void* userPtr),
                                                       void* userPtr);

#if defined(__cplusplus)
}
#endif

#endif
