/* Points: the phase, distances and closest interface at a point. See phasetree_embree.h for the conventions. */
#ifndef PHASETREE_EMBREE_POINT_H
#define PHASETREE_EMBREE_POINT_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* Returns the phase at a point, hidden phases included, and the radius of a ball around it that is guaranteed to
 * contain no other phase.
 *
 * point        in geometry space; finite.
 * time         the time of the motion; ignored if there is none.
 * emptyRadius  in geometry space, unlike the distances of phasetreeGetDistances. May be NULL. */
PHASETREE_API PhasetreeError phasetreeGetPhase(PhasetreeGeometry geometry, const float point[3], float time,
                                               unsigned int* phase, float* emptyRadius);

/* Returns Φ at a point: PHASETREE_MAX_PHASES signed distances, +∞ for phases that the object does not have. The phase
 * at the point is the one with the smallest distance. Distances are in the tree's units, even if the geometry is
 * scaled. point and time are as for phasetreeGetPhase. */
PHASETREE_API PhasetreeError phasetreeGetDistances(PhasetreeGeometry geometry, const float point[3], float time,
                                                   float distances[PHASETREE_MAX_PHASES]);

/* Transforms a point from geometry space to the tree's own space, the inverse of phasetreeSetGeometryMotion. point and
 * time are as for phasetreeGetPhase. For an instance, geometry space is the instanced scene's; transform a world-space
 * point by the inverse of objectToWorld first. */
PHASETREE_API PhasetreeError phasetreeGetTreePoint(PhasetreeGeometry geometry, const float point[3], float time,
                                                   float treePoint[3]);

/* An array of points. Strides are in bytes, positive multiples of 4. For interleaved coordinates (x, y, z), (x, y, z)
 * …, let x, y and z point into the first element and set `stride` to its size. For separate arrays, set `stride` to
 * sizeof(float). */
typedef struct PhasetreePoints {
    size_t count;
    const float *x, *y, *z; /* of the first point; ignored if count is 0 */
    size_t stride;
    const float* time; /* of the first point; NULL for time 0 */
    size_t timeStride; /* 0 if all points share *time */
} PhasetreePoints;

/* Sets the defaults: no points, one array per coordinate, time 0. */
static inline void phasetreeInitPoints(PhasetreePoints* points) {
    points->count = 0;
    points->x = points->y = points->z = NULL;
    points->stride = sizeof(float);
    points->time = NULL;
    points->timeStride = sizeof(float);
}

/* Returns the phases at many points. The results equal those of phasetreeGetPhase to the last bit. This call is several
 * times as fast, because eight points are evaluated together. Runs on the calling thread; to use more threads, call it
 * for parts of the points with disjoint outputs.
 *
 * phases      receives `count` phases.
 * emptyRadii  receives `count` radii, or NULL.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT   a stride is invalid, or a coordinate or time is not finite; the message names the
 *                                    point. Nothing is written
 * PHASETREE_ERROR_INVALID_OPERATION  the motion's transform has no inverse at a point's time. Nothing is written */
PHASETREE_API PhasetreeError phasetreeGetPhaseN(PhasetreeGeometry geometry, const PhasetreePoints* points,
                                                unsigned int* phases, float* emptyRadii);

/* Returns Φ at many points: the batched form of phasetreeGetDistances. Threads and points are as for
 * phasetreeGetPhaseN.
 * phaseCount   the number of phases to evaluate, from phase 0 on: 1 … PHASETREE_MAX_PHASES.
 * distances    the distance of phase k at point i is written pointStride·i + phaseStride·k bytes after this address.
 *              Both strides are multiples of 4. If the distances of one point are adjacent: pointStride = 4·phaseCount,
 *              phaseStride = 4. If the distances of one phase are adjacent: pointStride = 4, phaseStride = 4·count.
 *              Elements must not overlap: pointStride ≥ phaseCount · phaseStride, or phaseStride ≥ count · pointStride.
 *
 * Errors are those of phasetreeGetPhaseN, and PHASETREE_ERROR_INVALID_ARGUMENT for strides that overlap. */
PHASETREE_API PhasetreeError phasetreeGetDistancesN(PhasetreeGeometry geometry, const PhasetreePoints* points,
                                                    unsigned int phaseCount, float* distances, size_t pointStride,
                                                    size_t phaseStride);

/* The result of a search for the closest interface. */
typedef struct PhasetreeClosest {
    bool found;
    /* No interface is closer than emptyRadius, guaranteed. If `found`, `point` is within one resolution of an interface
     * between the phases `from` and `to`, and `distance` is its distance from the query point. If not, `distance` is
     * the radius requested, and `point`, `from` and `to` are not set. In that case, emptyRadius is usually at least
     * that radius. It is less if the search ended early (see phasetreeFindClosestInterface), or could not exclude an
     * interface in a box of about the resolution's size. */
    float emptyRadius;
    float distance;
    float point[3];
    unsigned int from, to; /* `from` is on the side of the query point, as far as that can be determined */
} PhasetreeClosest;

/* Finds the closest interface to a point, between any phases that are not both opaque (PhasetreeGeometryOptions).
 *
 * point, time   as for phasetreeGetPhase.
 * radius        the maximum distance to search; +∞ for no limit.
 * tolerance     stops when emptyRadius and distance differ by less than this fraction of distance; 0.001 … 1. Larger
 *               is faster. The search also stops when they are within four resolutions, and after 2^14 subdivisions.
 *
 * Uses branch and bound: subdivides the object's bounds into octants, and discards each octant in which the distances
 * at its centre, which are 1-Lipschitz, leave no room for an interface. */
PHASETREE_API PhasetreeError phasetreeFindClosestInterface(PhasetreeGeometry geometry, const float point[3], float time,
                                                           float radius, float tolerance, PhasetreeClosest* closest);

/* A geometry that takes part in point queries of a whole scene. The application lists them, because Embree does not
 * tell a point query's callback which geometry it is called for. */
typedef struct PhasetreePointQueryGeometry {
    unsigned int geomID, instID; /* instID of the innermost instance, or RTC_INVALID_GEOMETRY_ID */
    PhasetreeGeometry geometry;
} PhasetreePointQueryGeometry;

/* Input and output of a point query of a whole scene; the user pointer of rtcPointQuery. */
typedef struct PhasetreePointQuery {
    unsigned int apiVersion; /* PHASETREE_API_VERSION */
    const PhasetreePointQueryGeometry* geometries;
    unsigned int geometryCount;
    float tolerance; /* see phasetreeFindClosestInterface */
    /* Out: the closest interface so far, in world space, and the geometry it belongs to. Set closest.found to false
     * before the query. closest.emptyRadius is that of the geometry found. Over all listed geometries, no interface is
     * closer than distance·(1 − tolerance) or, if nothing was found, than the query's radius. This does not hold where
     * a search stopped early (see phasetreeFindClosestInterface). */
    PhasetreeClosest closest;
    unsigned int geomID, instID;
} PhasetreePointQuery;

/* The callback for rtcPointQuery; pass it to the query, or register it with geometries by
 * PHASETREE_GEOMETRY_FLAG_POINT_QUERY. The user pointer of the query must be a PhasetreePointQuery. Shrinks the query's
 * radius to the distance found, as Embree expects, so it can be combined with an application's callbacks for meshes by
 * dispatching on geomID. Works inside instances with any affine transform. Returns true if it shrank the radius. */
PHASETREE_API bool phasetreePointQueryFunction(struct RTCPointQueryFunctionArguments* args);

#if defined(__cplusplus)
}
#endif

#endif
