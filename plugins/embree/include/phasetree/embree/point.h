/* Points: the phase, the distances and the closest interface at one. The conventions are phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_POINT_H
#define PHASETREE_EMBREE_POINT_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* The phase at a point of the geometry as it stands (hidden phases included), and the radius of a ball around it in
 * which there certainly is no other; the second may be NULL.
 *
 * point  in geometry space; finite numbers.
 * time   of the motion; any number if there is none. */
PHASETREE_API PhasetreeError phasetreeGetPhase(PhasetreeGeometry geometry, const float point[3], float time,
                                               unsigned int* phase, float* emptyRadius);

/* Φ at a point: PHASETREE_MAX_PHASES signed distances, +∞ for phases that the object does not have. The phase is the
 * smallest one's. In the tree's units, also where the geometry is placed with a scale; the point as above. */
PHASETREE_API PhasetreeError phasetreeGetDistances(PhasetreeGeometry geometry, const float point[3], float time,
                                                   float distances[PHASETREE_MAX_PHASES]);

/* Takes a point of geometry space to the tree's own: what phasetreeSetGeometryMotion does to the object, undone. Point
 * and time as above. Within an instance geometry space is the instanced scene's; a point of the world is taken there
 * first, by the inverse of objectToWorld. */
PHASETREE_API PhasetreeError phasetreeGetTreePoint(PhasetreeGeometry geometry, const float point[3], float time,
                                                   float treePoint[3]);

/* Many points, each as above. Strides are in bytes, multiples of 4 and no less: of points with coordinates one after
 * another, (x, y, z), (x, y, z) …, x, y and z are addresses in the first one and `stride` is its size; of one array a
 * coordinate, `stride` is sizeof(float). */
typedef struct PhasetreePoints {
    size_t count;
    const float *x, *y, *z; /* of the first point; with a count of 0 not looked at */
    size_t stride;
    const float* time; /* of the first point; NULL: all at time 0 */
    size_t timeStride; /* 0: all at *time */
} PhasetreePoints;

/* Sets the defaults: no points, one array a coordinate, time 0. */
static inline void phasetreeInitPoints(PhasetreePoints* points) {
    points->count = 0;
    points->x = points->y = points->z = NULL;
    points->stride = sizeof(float);
    points->time = NULL;
    points->timeStride = sizeof(float);
}

/* Tells the phases at many points at once, as phasetreeGetPhase: to the last bit the same, several times as fast,
 * because eight points are evaluated together. On the calling thread alone; threads that share the work call it for
 * parts of the points, with outputs that do not overlap.
 *
 * phases      `count` of them.
 * emptyRadii  `count`, or NULL.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT   a stride is none, or a coordinate or a time no finite number: the message says of
 *                                    which point; nothing is written
 * PHASETREE_ERROR_INVALID_OPERATION  the motion's transform has no inverse at a point's time; nothing is written */
PHASETREE_API PhasetreeError phasetreeGetPhaseN(PhasetreeGeometry geometry, const PhasetreePoints* points,
                                                unsigned int* phases, float* emptyRadii);

/* Tells Φ at many points at once, as phasetreeGetDistances, and in the same way.
 *
 * phaseCount   the phases 0 … phaseCount − 1 are asked for; 1 … PHASETREE_MAX_PHASES.
 * distances    that of phase k at point i is written pointStride·i + phaseStride·k bytes behind it. Both strides are
 *              multiples of 4. Phases within points: pointStride = 4·phaseCount, phaseStride = 4; points within phases:
 *              pointStride = 4, phaseStride = 4·count. One stride must step over all that the other reaches, which is
 *              that times its count.
 *
 * Errors as above, and PHASETREE_ERROR_INVALID_ARGUMENT for strides that overlap. */
PHASETREE_API PhasetreeError phasetreeGetDistancesN(PhasetreeGeometry geometry, const PhasetreePoints* points,
                                                    unsigned int phaseCount, float* distances, size_t pointStride,
                                                    size_t phaseStride);

/* What a search for the closest interface has found. */
typedef struct PhasetreeClosest {
    bool found;
    /* No interface is nearer than emptyRadius, guaranteed. An interface is at `point`, at `distance`: between places of
     * phase `here` and of phase `there` that are no farther apart than the resolution. Without `found`, emptyRadius is
     * how far certainly no interface is: the radius that was asked for or more, or less where the evaluations came to
     * their end before; distance is that radius, and the rest is not set. */
    float emptyRadius;
    float distance;
    float point[3];
    unsigned int here, there; /* `here` is the phase on the side of the query's point, as far as it can be told */
} PhasetreeClosest;

/* The closest interface to a point, of any phases but between two that are opaque (PhasetreeGeometryOptions).
 *
 * point, time   as above.
 * radius        a distance: how far to look; +∞: everywhere.
 * tolerance     how near emptyRadius and distance come to each other before the search ends, as a share of distance:
 *               0.001 … 1; it also ends when they are within four resolutions, and after 2^14 divisions of
 *               the bounds at the latest. The larger, the quicker.
 *
 * Searches by branch and bound: divides the object's bounds into octants again and again, and excludes those in which
 * the 1-Lipschitz distances at the middle leave no room for an interface. */
PHASETREE_API PhasetreeError phasetreeFindClosestInterface(PhasetreeGeometry geometry, const float point[3], float time,
                                                           float radius, float tolerance, PhasetreeClosest* closest);

/* Point queries of whole scenes. Embree does not tell a point query's callback whose user pointer is whose, so the
 * application lists the geometries that it wants to be asked. */
typedef struct PhasetreePointQueryGeometry {
    unsigned int geomID, instID; /* instID: of the innermost instance, or RTC_INVALID_GEOMETRY_ID */
    PhasetreeGeometry geometry;
} PhasetreePointQueryGeometry;

/* What a point query of a whole scene is told, and what it finds: the user pointer of rtcPointQuery. */
typedef struct PhasetreePointQuery {
    unsigned int apiVersion; /* PHASETREE_API_VERSION */
    const PhasetreePointQueryGeometry* geometries;
    unsigned int geometryCount;
    float tolerance; /* see phasetreeFindClosestInterface */
    /* Out: the closest so far, in world space, and whose. closest.found must be false at first. closest.emptyRadius
     * is the one around the query's point in the geometry that was found, and says nothing of the others. Of all listed
     * geometries no interface is nearer than distance·(1 − tolerance), or than the query's radius if nothing was found,
     * but for the two other ends of a search that phasetreeFindClosestInterface names. */
    PhasetreeClosest closest;
    unsigned int geomID, instID;
} PhasetreePointQuery;

/* The callback for rtcPointQuery: given to it, or registered with geometries (PHASETREE_GEOMETRY_FLAG_POINT_QUERY). The
 * query's user pointer is a PhasetreePointQuery. Shrinks the query's radius to the distance found, as Embree wants it,
 * so that it goes well with an application's own callbacks for meshes, called from one that dispatches by geomID. Works
 * within instances of any affine transform. Returns true if it has shrunk the radius. */
PHASETREE_API bool phasetreePointQueryFunction(struct RTCPointQueryFunctionArguments* args);

#if defined(__cplusplus)
}
#endif

#endif
