// Includes Embree's header, and hides the differences between Embree 3 and Embree 4.
#pragma once

#if PHASETREE_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace phasetree::embree {

#if PHASETREE_EMBREE_MAJOR == 4

using Context = RTCRayQueryContext;

inline void initialise(Context& context) {
    rtcInitRayQueryContext(&context);
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray, &arguments);
}

inline bool occluded(RTCScene scene, Context& context, RTCRay& ray) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.context = &context;
    rtcOccluded1(scene, &ray, &arguments);
    return ray.tfar < 0;
}

#else

using Context = RTCIntersectContext;

inline void initialise(Context& context) {
    rtcInitIntersectContext(&context);
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray) {
    rtcIntersect1(scene, &context, &ray);
}

inline bool occluded(RTCScene scene, Context& context, RTCRay& ray) {
    rtcOccluded1(scene, &context, &ray);
    return ray.tfar < 0;
}

#endif

}  // namespace phasetree::embree
