/* Hits, and rays that carry phases. The conventions are phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_HIT_H
#define PHASETREE_EMBREE_HIT_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* A crossing: a change of phase on a ray, bracketed by two places of which each is proven to be in its phase.
 * The bracket is no longer than the resolution, or up to 2.75 of them where rounding puts a third phase between solids
 * that abut. A ray that is reflected goes on from pointIn in phaseLeft, one that passes from pointOut in phaseEntered;
 * nothing needs to be moved along a normal, and it meets this crossing no more if it carries that phase. */
typedef struct PhasetreeHit {
    unsigned int phaseLeft, phaseEntered;
    unsigned int cell;
    float tIn, tOut;               /* on the ray */
    float pointIn[3], pointOut[3]; /* in geometry space */
} PhasetreeHit;

/* Returns a phase of hit i among N, within a filter function (C has none of Embree's accessors) or anywhere else: the
 * one that the ray leaves, or the one that it enters. Only for hits of a phasetree geometry. */
static inline unsigned int phasetreeGetPhaseLeft(const struct RTCHitN* hits, unsigned int N, unsigned int i) {
    return (unsigned int)((const float*)hits)[3 * N + i];
}
static inline unsigned int phasetreeGetPhaseEntered(const struct RTCHitN* hits, unsigned int N, unsigned int i) {
    return (unsigned int)((const float*)hits)[4 * N + i];
}

/* Tells what a stock ray query has found: where exactly the phase ends and the next one begins. For which two phases
 * they are RTCHit.u and v suffice, and for the interface's normal Ng; a host that only shades a surface need not
 * decode. Decode to go on from a hit.
 *
 * rayhit       as the query left it: the ray's origin, direction, tnear and time, tfar and the hit, which must be one
 *              of this geometry.
 * objectToWorld  of the instance through which the ray met the geometry, 12 floats, 3×4 column-major, at the ray's time
 *              (for nested ones the product); NULL if hit.instID[0] is RTC_INVALID_GEOMETRY_ID.
 *
 * pointIn and pointOut are in geometry space: a host that wants them in the world applies objectToWorld itself.
 *
 * The bracket is found again, by a few samples on the ray around tfar, with the short program of the cell that the hit
 * names: that takes no longer than the ray took. (Where the hit's cell does not know it, because primID is wrong, say,
 * the whole object is asked, and that may take many times as long.) tOut and pointOut are moved on, by less than two
 * resolutions, to where the phase is certain in spite of the rounding that a new ray undergoes: the same ray with
 * tnear = tOut starts in phaseEntered, so that a host that carries no phases neither meets this crossing again nor
 * passes the next one, as long as phases are thicker along the ray than some five resolutions. */
PHASETREE_API PhasetreeError phasetreeDecodeHit(PhasetreeGeometry geometry, const struct RTCRayHit* rayhit,
                                                const float* objectToWorld, PhasetreeHit* hit);

/* Tells where a hit is in the tree's own space, whatever motion and instances do to the object: a place for solid
 * textures, which then move with it. The point of the ray at tfar, within the rounding of that; nothing is decoded and
 * nothing evaluated. rayhit and objectToWorld as above, and phases are not looked at. For other points, such as a
 * decoded hit's pointIn and pointOut, see phasetreeGetTreePoint. */
PHASETREE_API PhasetreeError phasetreeGetHitTreePoint(PhasetreeGeometry geometry, const struct RTCRayHit* rayhit,
                                                      const float* objectToWorld, float treePoint[3]);

/* That a ray, where it starts, is in `phase` of the geometry geomID, within the instance instID (and, with Embree 4,
 * instPrimID) or none: RTC_INVALID_GEOMETRY_ID. Of nested instances, the innermost's. */
typedef struct PhasetreeMedium {
    unsigned int geomID, instID, instPrimID;
    unsigned int phase;
} PhasetreeMedium;

/* What one ray brings along, and what it takes home. */
typedef struct PhasetreeRay {
    /* In: the phases that the ray carries. For a geometry that is not listed, or with PHASETREE_UNKNOWN_PHASE, the
     * phase at the ray's start counts, as with a stock context. If another phase is at the start than the one carried,
     * beyond what rounding explains, that is a crossing where it is noticed: at the start, if that is near an
     * interface, else where the ray comes near the next one. Owned by the application; not written. */
    const PhasetreeMedium* media;
    unsigned int mediumCount;
    /* Out: the crossing behind the last hit that a geometry of this library reported for the ray. If the ray's hit is a
     * geometry of this library, this is that hit's; its normal is in the hit. Left alone by occlusion queries. */
    PhasetreeHit hit;
} PhasetreeRay;

/* An Embree context that lets rays carry phases. Pass &context.context where Embree wants a context. Opt-in: only for
 * scenes whose phasetree geometries have PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT; meshes do not mind it. */
typedef struct PhasetreeRayContext {
#if RTC_VERSION_MAJOR >= 4
    struct RTCRayQueryContext context;
#else
    struct RTCIntersectContext context;
#endif
    unsigned int apiVersion; /* set by phasetreeInitRayContext */
    /* Element i is the ray's whose RTCRay.id is i: 0 for a single ray, and as the application numbers them for packets.
     * Rays with an id of rayCount or more carry nothing. Owned by the application. Rays of different queries that run
     * at once must not share an element. */
    PhasetreeRay* rays;
    unsigned int rayCount;
    /* Called, if not NULL, for each crossing of a phasetree geometry after all other filters: what with Embree 4 a
     * query's argument filter is to meshes. */
    void (*filter)(const struct RTCFilterFunctionNArguments* args);
} PhasetreeRayContext;

/* Initialises Embree's context, and ours so that rays carry nothing. */
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
