/* phasetree as Embree geometry: the C99 interface.
 *
 * An application loads a tree, creates an RTCGeometry from it, and commits, attaches, instances, masks and filters that
 * geometry like any other. There is one library per version of Embree: phasetree_embree3 for Embree 3.13 and
 * phasetree_embree4 for Embree 4. This header serves both. It includes the Embree header selected by
 * PHASETREE_EMBREE_MAJOR, which the CMake targets and pkg-config files define; if rtcore.h was included before, that
 * version is used.
 *
 * CONVENTIONS
 *
 * These hold for every call and are not repeated below.
 *
 * Units. A tree has one unit of length, that of its scene file; a "distance" is measured in it. Distances *along a ray*
 * (tFrom, tTo) are in units of the length of the ray's direction, like Embree's tnear and tfar. Angles are in degrees.
 *
 * Spaces. "Geometry space" is the space of the RTCScene to which the geometry is attached; for an instance, the
 * instanced scene's. Without motion (phasetreeSetGeometryMotion) it is the tree's own space.
 *
 * Sides. The two phases at an interface are called `from` and `to`: a ray passes from `from` to `to`. Members
 * that belong to one side have its name as a suffix: tFrom and pointFrom are in `from`, tTo and pointTo in `to`. For
 * the closest interface to a point (PhasetreeClosest), `from` is on the side of that point. RTCHit.Ng points into
 * `from`, against the ray; the normal of a PhasetreePreciseCrossing points into `to`.
 *
 * Errors. Functions that can fail return a PhasetreeError, except phasetreeNewImageValues(), which returns NULL,
 * and phasetreePointQueryFunction(), which returns false. If the error is not PHASETREE_ERROR_NONE, nothing has
 * changed, the outputs are untouched, and phasetreeGetErrorMessage() says which argument is wrong and why. No C++
 * exception leaves the library. No argument makes it abort, except invalid memory: an array that is too short, a string
 * that is not null-terminated, or an invalid pointer.
 *
 * Handles. PhasetreeTree and PhasetreeGeometry are opaque and reference counted. phasetreeNewTree… and
 * phasetreeNewGeometry… return a handle with one reference, owned by the caller. Retain adds a reference, Release drops
 * one, and dropping the last one frees the object. NULL, freed handles, handles of the other kind and arbitrary
 * pointers are detected and give PHASETREE_ERROR_INVALID_HANDLE; handle values are never reused. Releasing a handle too
 * often while others hold references drops one of theirs, which no library can detect.
 *
 * Threads. Any thread may call any function at any time, with one exception: an "exclusive" call must not run while
 * another thread uses the same geometry in any way, including tracing a scene it is attached to. (Embree has the same
 * rule for calls that modify a geometry.) Trees are immutable, so all calls on one tree may run concurrently. Keep a
 * reference to a handle for as long as a call that uses it runs.
 *
 * Arithmetic. The library flushes subnormal numbers to zero on every thread, and restores the calling thread's
 * floating-point mode before it returns.
 */
#ifndef PHASETREE_EMBREE_H
#define PHASETREE_EMBREE_H

#include "phasetree/embree/bounds.h"
#include "phasetree/embree/callbacks.h"
#include "phasetree/embree/common.h"
#include "phasetree/embree/geometry.h"
#include "phasetree/embree/hit.h"
#include "phasetree/embree/measure.h"
#include "phasetree/embree/mesh.h"
#include "phasetree/embree/point.h"
#include "phasetree/embree/precise.h"
#include "phasetree/embree/tree.h"

#endif
