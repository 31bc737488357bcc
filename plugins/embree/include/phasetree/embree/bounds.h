/* Bounds: convex volumes around a tree and its phases. See phasetree_embree.h for the conventions. */
#ifndef PHASETREE_EMBREE_BOUNDS_H
#define PHASETREE_EMBREE_BOUNDS_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* The maximum number of planes of carved bounds. */
#define PHASETREE_MAX_PLANES 256

/* The half-space normal·p ≤ offset. The normal points outward and has unit length. */
typedef struct PhasetreePlane {
    float normal[3];
    float offset;
} PhasetreePlane;

/* Options of phasetreeCarveTree. Initialise them with phasetreeInitCarveOptions. */
typedef struct PhasetreeCarveOptions {
    unsigned int maxPlanes; /* 6 … PHASETREE_MAX_PLANES; includes the six sides of the box */
    float tolerance;        /* target distance between planes and object, as a fraction of the object's diagonal */
    /* Budget, in evaluations of eight points; if it runs out, the volume is looser, but valid. */
    size_t maxEvaluations;
    /* Polled by the calling thread; return true to cancel with PHASETREE_ERROR_CANCELLED. May be NULL. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
} PhasetreeCarveOptions;

/* Sets the defaults. */
static inline void phasetreeInitCarveOptions(PhasetreeCarveOptions* options) {
    options->maxPlanes = 40;
    options->tolerance = 1e-3f;
    options->maxEvaluations = 50000;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
}

/* Properties of carved bounds, besides the planes. */
typedef struct PhasetreeCarvedBounds {
    struct RTCBounds box; /* lower > upper if the phases are empty */
    float volume, area;   /* of the polyhedron; 0 if the phases are empty */
    size_t evaluations;   /* number of evaluations used */
    bool isWithinTolerance;
} PhasetreeCarvedBounds;

/* Carves a convex volume that is guaranteed to contain all of the given phases: a box, and planes that cut off its
 * corners and follow flat sides of the object. It uses nothing but the tree's distances at sample points ("Sphere
 * Carving", Schott et al. 2025).
 *
 * phases      the phases to enclose; PHASETREE_ALL_PHASES means all but the vacuum, which is always ignored. The tree
 *             must have at least one of them.
 * options     NULL for the defaults.
 * planes      receives up to options->maxPlanes planes, or NULL. The phases lie behind every plane.
 * planeCount  receives the number of planes, 0 if the phases are empty. May be NULL if planes is NULL.
 * bounds      receives the other properties, or NULL.
 *
 * Runs on the calling thread. Slower than phasetreeGetTreeBounds: milliseconds if the tree's distances are exact, up to
 * a second for a tree of a thousand nodes with inexact distances.
 *
 * PHASETREE_ERROR_INVALID_TREE  the tree is unbounded, or too far from the origin for its size */
PHASETREE_API PhasetreeError phasetreeCarveTree(PhasetreeTree tree, PhasetreePhaseSet phases,
                                                const PhasetreeCarveOptions* options, PhasetreePlane* planes,
                                                unsigned int* planeCount, PhasetreeCarvedBounds* bounds);

#if defined(__cplusplus)
}
#endif

#endif
