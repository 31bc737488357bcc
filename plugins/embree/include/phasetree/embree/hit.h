/* Hits, and rays that carry phases. See phasetree_embree.h for the conventions. */
#ifndef PHASETREE_EMBREE_HIT_H
#define PHASETREE_EMBREE_HIT_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* A crossing: a change of phase along a ray. It lies between two points on the ray, its bracket: pointFrom is proven to
 * be in the phase `from`, and pointTo in the phase `to`.
 *
 * The bracket is at most one resolution long, or up to 2.75 resolutions where rounding puts a third phase between
 * abutting solids. phasetreeDecodeHit lengthens it by less than two resolutions.
 *
 * Continue a reflected ray from pointFrom, and a transmitted ray from pointTo. Do not offset either point along a
 * normal: a ray that carries its phase (PhasetreeRay) does not hit this crossing again. */
typedef struct PhasetreeHit {
    unsigned int from, to; /* the phases before and after the crossing */
    unsigned int cell;
    float tFrom, tTo;               /* of pointFrom and pointTo, along the ray */
    float pointFrom[3], pointTo[3]; /* in geometry space */
} PhasetreeHit;

/* Returns the phase before (`from`) or after (`to`) hit i of N. Unlike Embree's accessors, which are C++ only, these
 * functions also work in C filter functions. Valid only for hits of a phasetree geometry. */
static inline unsigned int phasetreeGetHitFrom(const struct RTCHitN* hits, unsigned int N, unsigned int i) {
    return (unsigned int)((const float*)hits)[3 * N + i];
}
static inline unsigned int phasetreeGetHitTo(const struct RTCHitN* hits, unsigned int N, unsigned int i) {
    return (unsigned int)((const float*)hits)[4 * N + i];
}

/* Decodes the hit of an ordinary ray query: finds the bracket of the crossing, and moves its far end slightly forward
 * (see below). Decode a hit only to continue a ray from it. To shade a surface, RTCHit.u and v (the two phases) and Ng
 * (the normal) are enough.
 *
 * rayhit         as left by the query: the ray's origin, direction, tnear, time and tfar, and a hit of this geometry.
 * objectToWorld  the transform of the instance through which the ray hit the geometry, at the ray's time: 12 floats,
 *                3×4 column-major; the product of all transforms for nested instances. NULL if hit.instID[0] is
 *                RTC_INVALID_GEOMETRY_ID.
 *
 * pointFrom and pointTo are in geometry space; apply objectToWorld to get world coordinates.
 *
 * The bracket is recomputed from a few samples along the ray around tfar, using the short program of the hit's cell.
 * This takes no longer than tracing the ray. If primID does not name that cell, the whole object is evaluated, which
 * can take many times as long.
 *
 * tTo and pointTo are moved forward by less than two resolutions. The same ray with tnear = tTo is then certain to
 * start in `to`, despite rounding, so an application that does not carry phases can continue from tTo. It does not hit
 * this crossing again, and does not skip the next one if phases are thicker along the ray than about five resolutions.
 */
PHASETREE_API PhasetreeError phasetreeDecodeHit(PhasetreeGeometry geometry, const struct RTCRayHit* rayhit,
                                                const float* objectToWorld, PhasetreeHit* hit);

/* Returns the position of a hit in the tree's own space, with motion and instances undone: the point at which to
 * evaluate solid textures, so that they move with the object. This is the ray's point at tfar, up to rounding; nothing
 * is decoded or evaluated, and phases are ignored. rayhit and objectToWorld are as for phasetreeDecodeHit. For other
 * points, such as a decoded hit's pointFrom and pointTo, use phasetreeGetTreePoint. */
PHASETREE_API PhasetreeError phasetreeGetHitTreePoint(PhasetreeGeometry geometry, const struct RTCRayHit* rayhit,
                                                      const float* objectToWorld, float treePoint[3]);

/* The phase of one geometry in which a ray starts. instID (and in Embree 4 instPrimID) name the instance of the
 * geometry: the innermost one if instances are nested, and RTC_INVALID_GEOMETRY_ID without an instance. */
typedef struct PhasetreeCarriedPhase {
    unsigned int geomID, instID, instPrimID;
    unsigned int phase;
} PhasetreeCarriedPhase;

/* Per-ray input and output of a query with a PhasetreeRayContext. */
typedef struct PhasetreeRay {
    /* In: the phases that the ray carries. A geometry that is not listed, or has PHASETREE_UNKNOWN_PHASE, uses the
     * phase at the ray's start, as with an ordinary context. If the ray starts deeper in another phase than rounding
     * errors can explain, the library reports a crossing from it to the real phase. This crossing is at the ray's start
     * if that is in a cell, otherwise where the ray enters the next cell. Owned by the application; not modified. */
    const PhasetreeCarriedPhase* carried;
    unsigned int carriedCount;
    /* Out: the crossing that belongs to the closest hit, if that hit is on a phasetree geometry. Its normal is in
     * RTCHit. If another geometry is closer, this is a crossing that was found and then discarded. Unchanged by
     * occlusion queries. */
    PhasetreeHit hit;
} PhasetreeRay;

/* An Embree context with which rays carry phases. Pass &context.context to Embree. Opt-in: all phasetree geometries in
 * the scene must have PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT. Meshes are unaffected. */
typedef struct PhasetreeRayContext {
#if RTC_VERSION_MAJOR >= 4
    struct RTCRayQueryContext context;
#else
    struct RTCIntersectContext context;
#endif
    unsigned int apiVersion; /* set by phasetreeInitRayContext */
    /* Element i belongs to the ray whose RTCRay.id is i. Set id to 0 for a single ray, and number the rays of packets.
     * Rays with an id of rayCount or more carry nothing. Owned by the application. Concurrent queries must not share
     * elements. */
    PhasetreeRay* rays;
    unsigned int rayCount;
    /* Called for each crossing of a phasetree geometry after all other filters; the counterpart of the filter in the
     * arguments of Embree 4's queries. May be NULL. */
    void (*filter)(const struct RTCFilterFunctionNArguments* args);
} PhasetreeRayContext;

/* Initialises a context, including Embree's part, so that rays carry no phases. */
static inline void phasetreeInitRayContext(PhasetreeRayContext* context) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context->context);
#else
    rtcInitIntersectContext(&context->context);
#endif
    context->apiVersion = PHASETREE_API_VERSION;
    context->rays = NULL;
    context->rayCount = 0;
    context->filter = NULL;
}

#if defined(__cplusplus)
}
#endif

#endif
