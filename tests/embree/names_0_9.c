/* A fragment of a host written for version 0.9: compiles by names_0_9.h (installed.cmake). */
#include <phasetree/phasetree_embree.h>

#include <phasetree/embree/names_0_9.h>

unsigned int entered(const struct RTCHitN* hits, unsigned int N) {
    return phasetreeGetPhaseLeft(hits, N, 0) == PHASETREE_VACUUM ? phasetreeGetPhaseEntered(hits, N, 0) : 0;
}

float step(PhasetreeRay* ray, PhasetreeMedium* phases) {
    ray->media = phases;
    ray->mediumCount = 1;
    if (ray->media[0].phase != ray->hit.phaseLeft) phases[0].phase = ray->hit.phaseEntered;
    return ray->hit.tOut - ray->hit.tIn + ray->hit.pointOut[0] - ray->hit.pointIn[0];
}

bool changes(const PhasetreeClosest* closest) {
    return closest->here != closest->there;
}
