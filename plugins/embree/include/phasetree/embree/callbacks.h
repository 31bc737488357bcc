/* Callbacks, for applications that dispatch between several geometries themselves. See phasetree_embree.h for the
 * conventions. */
#ifndef PHASETREE_EMBREE_CALLBACKS_H
#define PHASETREE_EMBREE_CALLBACKS_H

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* The callbacks that phasetreeNewGeometry registers with Embree. geometryUserPtr is the PhasetreeGeometry. */
PHASETREE_API void phasetreeBoundsFunction(const struct RTCBoundsFunctionArguments* args);
PHASETREE_API void phasetreeIntersectFunction(const struct RTCIntersectFunctionNArguments* args);
PHASETREE_API void phasetreeOccludedFunction(const struct RTCOccludedFunctionNArguments* args);

/* Callbacks for one primitive of the application's own RTCGeometry. The application's callbacks call these with the
 * handle and the very arguments pointer they received from Embree. Do not pass a copy: Embree stores private data
 * behind the arguments.
 *
 * primID is ignored, unless the handle has PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES. Then it selects the cell, and must
 * be below PhasetreeGeometryStatistics.cells; otherwise nothing is hit and the bounds are empty. The filter functions
 * of the application's RTCGeometry apply. A geometry whose handle has been freed is never hit and has empty bounds. */
PHASETREE_API void phasetreeGetPrimitiveBounds(PhasetreeGeometry geometry,
                                               const struct RTCBoundsFunctionArguments* args);
PHASETREE_API void phasetreeIntersectPrimitive(PhasetreeGeometry geometry,
                                               const struct RTCIntersectFunctionNArguments* args);
PHASETREE_API void phasetreeOccludedPrimitive(PhasetreeGeometry geometry,
                                              const struct RTCOccludedFunctionNArguments* args);

#if defined(__cplusplus)
}
#endif

#endif
