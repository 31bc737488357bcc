/* phasetree as Embree geometry: the C99 interface.
 *
 * An application loads a tree, makes an RTCGeometry of it, and commits, attaches, instances, masks and filters that
 * as any other. Embree 3.13 and Embree 4 have a library each, phasetree_embree3 and phasetree_embree4; this header
 * serves both and includes the Embree header that belongs to the library linked (PHASETREE_EMBREE_MAJOR, which the
 * CMake targets and the pkg-config files define; an rtcore.h included before it decides otherwise).
 *
 * CONVENTIONS, which hold for every call below and are not said again
 *
 * Units. A tree has one unit of length, the scene file's; "distance" means that unit. Distances *along a ray* (tIn,
 * tOut) are in units of the length of the ray's direction, as Embree's tnear and tfar. Angles are in degrees.
 *
 * Spaces. "Geometry space" is that of the RTCScene to which the geometry is attached: within an instance, the
 * instanced scene's. Without motion (phasetreeSetGeometryMotion) it is the tree's own space.
 *
 * Errors. Every call returns a PhasetreeError. On anything but PHASETREE_ERROR_NONE nothing has changed, nothing was
 * written to the call's outputs, and phasetreeGetErrorMessage() tells a person which argument is wrong and why. No C++
 * exception leaves the library, and no argument makes it abort, except memory that is not what the call's documentation
 * says (an array that is too short, a text that does not end, a pointer to nowhere).
 *
 * Handles. PhasetreeTree and PhasetreeGeometry are opaque and reference counted. Calls named New return a handle with
 * one reference, which belongs to the caller; Retain adds one, Release takes one away, and the last one frees. NULL,
 * handles already freed, handles of the other kind and pointers that are no handles at all are recognised and are
 * PHASETREE_ERROR_INVALID_HANDLE; a handle's value is never used twice. (A *reference* released too often while others
 * hold some is theirs that is lost: no library can tell whose it was.)
 *
 * Threads. Any thread may call anything at any time, except: a call marked "exclusive" must not run while another
 * thread uses the same geometry in any way, tracing a scene that it is attached to included (so it is in Embree, too,
 * with what changes a geometry). Trees are immutable; all calls on one tree may run at once. A handle must keep a
 * reference while a call that it was given to runs.
 *
 * Arithmetic. The library computes with subnormal numbers taken for zero, on every thread, and puts the thread's
 * floating-point mode back when it returns.
 */
#ifndef PHASETREE_EMBREE_H
#define PHASETREE_EMBREE_H

#include "phasetree/embree/bounds.h"
#include "phasetree/embree/callbacks.h"
#include "phasetree/embree/common.h"
#include "phasetree/embree/geometry.h"
#include "phasetree/embree/hit.h"
#include "phasetree/embree/mesh.h"
#include "phasetree/embree/point.h"
#include "phasetree/embree/tree.h"

#endif
