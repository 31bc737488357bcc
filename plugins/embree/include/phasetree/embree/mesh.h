/* Meshes: the interfaces of a geometry as triangles, for a viewport that rasterises or for another program. The
 * conventions are phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_MESH_H
#define PHASETREE_EMBREE_MESH_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* What phasetreeMakeGeometryMesh may be told; start from phasetreeInitMeshOptions. */
typedef struct PhasetreeMeshOptions {
    float spacing; /* of the grid, about the size of the smallest that is kept; 0: a 256th of the longest side. 1024
                    * points of the grid along a side of the object at most */
    /* Asked now and then, by any thread; true ends the call with PHASETREE_ERROR_CANCELLED. NULL: never. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
    /* Called now and then with the share that is done, in (0, 1], by one thread at a time. NULL: nobody is. */
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

/* Triangles of the interfaces between phases, each there once. They share their vertices, so the triangles at which a
 * phase is on one side alone are its closed surface, a manifold. */
typedef struct PhasetreeMesh {
    const float* vertices;       /* 3 · vertexCount coordinates, in the tree's own space */
    const unsigned int* indices; /* 3 · triangleCount; counterclockwise as seen from the phase in front */
    const unsigned char* behind; /* triangleCount phases: the one behind, of the higher number */
    const unsigned char* front;  /* triangleCount phases: the one in front; 0 is the vacuum */
    size_t vertexCount, triangleCount;
    float spacing; /* that was used */
    /* How many crossings there are along the lines of the grid, and how many of these are not shown, because a phase is
     * thinner there than the spacing. */
    size_t crossings, passedOver;
} PhasetreeMesh;

/* Makes a mesh of the interfaces of a geometry by rays through its cells (phasetree/meshing/phase_mesh.hpp says how),
 * and hands it over.
 *
 * options  NULL: the defaults.
 * receive  called once with the mesh, by the calling thread, if there is no error. Its arrays are the library's, and
 *          gone when it returns. It must not throw.
 * userPtr  is passed on to it.
 *
 * All phases are in it, whatever is hidden, and it is where the tree is, whatever moves the geometry. It uses the
 * threads of TBB's default arena, and is the same for any number of them; it takes about a second for the default
 * spacing.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT   the spacing is none, or would take too many points
 * PHASETREE_ERROR_INVALID_OPERATION  the geometry was built with opaque phases, in which nothing is found
 * PHASETREE_ERROR_CANCELLED          options->cancelled has ended it */
PHASETREE_API PhasetreeError phasetreeMakeGeometryMesh(PhasetreeGeometry geometry, const PhasetreeMeshOptions* options,
                                                       void (*receive)(const PhasetreeMesh* mesh, void* userPtr),
                                                       void* userPtr);

#if defined(__cplusplus)
}
#endif

#endif
