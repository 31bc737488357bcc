/* Double precision, for simulations of particles, light and sound: phases, safe distances and crossings of a tree, in
 * the tree's own space, without an Embree device or scene. See phasetree_embree.h for the conventions, and
 * phasetree/trace/precise_tracer.hpp for what is guaranteed. */
#ifndef PHASETREE_EMBREE_PRECISE_H
#define PHASETREE_EMBREE_PRECISE_H

#include "phasetree/embree/tree.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* All calls below use the threads of TBB's default arena; results do not depend on their number. The first call for a
 * tree prepares it. Points are arrays of 3 · count coordinates x, y, z, x, y, z, …, all of which must be finite. */

/* Returns the phases at points: at each point, the phase with the smallest distance, computed in double precision. If
 * several phases have the same distance, the one with the lowest index wins.
 *
 * phases  receives `count` phases.
 * PHASETREE_ERROR_INVALID_ARGUMENT  a coordinate is not finite; the message names the point
 * PHASETREE_ERROR_INVALID_TREE      the tree has too many nodes to evaluate */
PHASETREE_API PhasetreeError phasetreeLocate(PhasetreeTree tree, const double* points, size_t count,
                                             unsigned int* phases);

/* Returns, for each point, a radius within which the phase is guaranteed not to change; 0 at interfaces.
 *
 * distances  receives `count` radii.
 * Errors are those of phasetreeLocate, and PHASETREE_ERROR_INVALID_TREE if the tree is too far from the origin for its
 * size. */
PHASETREE_API PhasetreeError phasetreeGetSafeDistances(PhasetreeTree tree, const double* points, size_t count,
                                                       double* distances);

/* A ray in double precision. */
typedef struct PhasetreePreciseRay {
    double origin[3];
    double direction[3];  /* of any length but zero */
    double tMax;          /* crossings beyond tMax are not found; INFINITY for no limit */
    unsigned int carried; /* the phase that the ray is in; PHASETREE_UNKNOWN_PHASE for the one at its origin */
} PhasetreePreciseRay;

/* The next change of phase along a ray. If there is none, tFrom and tTo are infinite, both phases are the one that the
 * ray is in, and all other members are 0. */
typedef struct PhasetreePreciseCrossing {
    double tFrom, tTo;     /* of pointFrom and pointTo, in units of the length of the ray's direction */
    double pointFrom[3];   /* in `from`; a reflected ray starts here and carries `from` */
    double pointTo[3];     /* in `to`; the ray goes on from here and carries `to` */
    double normal[3];      /* of unit length, from `from` into `to`; RTCHit.Ng points the other way */
    unsigned int from, to; /* the phases before and after the crossing */
} PhasetreePreciseCrossing;

/* Finds the next crossing of each ray. A walk that restarts at pointTo and carries `to` repeats no crossing, and `to`
 * of each is `from` of the next. Phases that are thinner along the ray than the resolution of
 * phasetree::PreciseTracer (usually 2⁻³⁰ of the object's diagonal) may be missed.
 *
 * crossings         receives `count` crossings.
 * cancelled         polled from any thread; return true to cancel. May be NULL.
 * cancelledUserPtr  passed to cancelled.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT  a ray is not finite, has a zero direction or carries a phase that the tree does not
 *                                   have; the message names the ray
 * PHASETREE_ERROR_INVALID_TREE      the tree is empty or unbounded, or too far from the origin for its size
 * PHASETREE_ERROR_CANCELLED         cancelled returned true. Nothing is written */
PHASETREE_API PhasetreeError phasetreeFindCrossings(PhasetreeTree tree, const PhasetreePreciseRay* rays, size_t count,
                                                    PhasetreePreciseCrossing* crossings,
                                                    bool (*cancelled)(void* userPtr), void* cancelledUserPtr);

#if defined(__cplusplus)
}
#endif

#endif
