/* Bounds: convex volumes around a tree and its phases. The conventions are phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_BOUNDS_H
#define PHASETREE_EMBREE_BOUNDS_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* The most planes of carved bounds. */
#define PHASETREE_MAX_PLANES 256

/* The points p with normal·p ≤ offset; the normal is outward and of unit length. */
typedef struct PhasetreePlane {
    float normal[3];
    float offset;
} PhasetreePlane;

/* What phasetreeCarveTree may be told; start from phasetreeInitCarveOptions. */
typedef struct PhasetreeCarveOptions {
    unsigned int mostPlanes; /* 6 … PHASETREE_MAX_PLANES; the box's sides are among them */
    float tolerance;         /* how far planes may be from the object, as a share of its diagonal, if work suffices */
    size_t
        mostEvaluations; /* of eight points each; what is not reached within them is larger, and certain all the same */
    /* Asked now and then, by the calling thread; true ends the call with PHASETREE_ERROR_CANCELLED. NULL: never. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
} PhasetreeCarveOptions;

/* Sets the defaults. */
static inline void phasetreeInitCarveOptions(PhasetreeCarveOptions* options) {
    options->mostPlanes = 40;
    options->tolerance = 1e-3f;
    options->mostEvaluations = 50000;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
}

/* What was carved, besides the planes. */
typedef struct PhasetreeCarvedBounds {
    struct RTCBounds box; /* lower > upper if there is nothing of the phases */
    float volume, area;   /* of the polyhedron; 0 if there is nothing */
    size_t evaluations;   /* that it took */
    bool isWithinTolerance;
} PhasetreeCarvedBounds;

/* Carves a convex volume that certainly contains all of some phases, from their distances alone ("Sphere Carving",
 * Schott et al. 2025): a box, and planes that cut its corners off and follow flat sides of the object.
 *
 * phases      PHASETREE_ALL_PHASES: all but the vacuum, which never counts. Of those that are given the tree must have
 *             one at least.
 * options     NULL: the defaults.
 * planes      room for options->mostPlanes of them, or NULL. All of the phases is behind all of them.
 * planeCount  receives how many there are; none if there is nothing of the phases. NULL if planes is.
 * bounds      receives the rest, or NULL.
 *
 * On the calling thread. It takes longer than phasetreeGetTreeBounds: milliseconds where the tree's distances are
 * exact, up to a second for a tree of a thousand nodes whose distances are not.
 *
 * PHASETREE_ERROR_INVALID_TREE  the tree is unbounded, or too far from the origin for its size */
PHASETREE_API PhasetreeError phasetreeCarveTree(PhasetreeTree tree, PhasetreePhaseSet phases,
                                                const PhasetreeCarveOptions* options, PhasetreePlane* planes,
                                                unsigned int* planeCount, PhasetreeCarvedBounds* bounds);

#if defined(__cplusplus)
}
#endif

#endif
