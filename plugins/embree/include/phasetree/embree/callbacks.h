/* Callbacks, for applications that dispatch between geometries of their own. The conventions are phasetree_embree.h's.
 */
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

/* Callbacks for a primitive of an RTCGeometry that is the application's own: from its callbacks it calls these with the
 * handle, and the arguments just as Embree gave them (Embree keeps more behind them than it tells; a copy will not do).
 * primID is not looked at, unless the handle has PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES: then it is the cell, below
 * PhasetreeGeometryStatistics.cells, and for any other nothing is hit and the bounds are empty. Filters are those of
 * the application's RTCGeometry. Handles without references: nothing is hit, and the bounds are empty. */
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
