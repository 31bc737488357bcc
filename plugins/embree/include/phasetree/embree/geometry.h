/* Geometries: an RTCGeometry of a tree, its options, edits and motion. The conventions are phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_GEOMETRY_H
#define PHASETREE_EMBREE_GEOMETRY_H

#include "phasetree/embree/tree.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* A set of phases: bit i stands for the phase i. */
typedef uint64_t PhasetreePhaseSet;
#define PHASETREE_ALL_PHASES (~(PhasetreePhaseSet)0)

/* What is particular to a geometry, as bits of PhasetreeGeometryOptions.flags. */
typedef enum PhasetreeGeometryFlags {
    PHASETREE_GEOMETRY_FLAG_NONE = 0,
    /* Every ray query that can reach the geometry has a PhasetreeRayContext for its context: see there. Without the
     * flag the geometry takes nothing from a context but what Embree put there. */
    PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT = 1 << 0,
    /* Promises that neither the geometry nor any query has a filter function: none is called then, and occlusion rays
     * may stop at the first crossing that is found instead of the first on the ray. */
    PHASETREE_GEOMETRY_FLAG_NO_FILTERS = 1 << 1,
    /* Registers phasetreePointQueryFunction with the geometry. Every rtcPointQuery that can reach it must then be given
     * a PhasetreePointQuery as its user pointer. */
    PHASETREE_GEOMETRY_FLAG_POINT_QUERY = 1 << 2,
    /* The RTCGeometry has one primitive for each cell, found by Embree's tree over the application's scene, instead of
     * one primitive that traces a scene of its own. Rays find the same, alone and in packets, with carried phases and
     * without, and faster: up to a third. For that NO_FILTERS must be set as well, because a filter function would see
     * some crossings twice; POINT_QUERY must not; all phases are shown; and the object moves only within instances. The
     * application's scene has as many primitives more as there are cells, and others after phasetreeSetGeometryTree. A
     * scene of the geometry's own is built when phasetreeFindClosestInterface is first called, or phasetreeDecodeHit
     * for a hit that names a wrong cell. */
    PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES = 1 << 3
} PhasetreeGeometryFlags;

/* What phasetreeNewGeometry and phasetreeSetGeometryTree may be told; start from phasetreeInitGeometryOptions. */
typedef struct PhasetreeGeometryOptions {
    unsigned int flags; /* PhasetreeGeometryFlags; what phasetreeSetGeometryTree is told of them it does not look at */
    /* A distance: brackets are no longer, and what is thinner along a ray may be passed. 0: 2·10⁻⁶ of the diagonal of
     * the tree's bounds, or what 32-bit coordinates allow where the tree is far from the origin. Any other is used as
     * near as possible: no finer than 2.5·10⁻⁷ of the farthest coordinate or the diagonal, no coarser than a hundredth
     * of the diagonal. phasetreeGetGeometryStatistics tells which is used, phasetreeGetGeometryWarning why. */
    float resolution;
    /* RTCBuildQuality: how finely the object is cut into cells, the boxes in which rays look for interfaces. LOW builds
     * in a quarter to two thirds of the time, for objects that are edited, and rays are slower; MEDIUM and HIGH are the
     * same. What rays find is, too. */
    unsigned int buildQuality;
    unsigned int cellDivisions; /* at most so many times from the bounds on, 20 or fewer; 0: the library's choice */
    /* About how many bytes the cells and Embree's tree over them may take, and building them. Where they would take
     * more, cells are larger, and rays find the same more slowly. 0: 2 GiB, or a quarter of what the machine has or
     * the process may use, if that is less. phasetreeGetGeometryStatistics tells what they take. */
    size_t mostBytes;
    /* Phases to show: a crossing between two phases of which none is in the set is passed as if it were not there. The
     * vacuum never counts as shown, in the set or not. To hide one phase, leave it out. */
    PhasetreePhaseSet shownPhases;
    /* Phases that no ray of yours is ever in, because your materials for them are opaque. Nothing is looked for where
     * two of them meet, and the geometry is as fast to build and to trace as its outer surface alone. A ray that is in
     * one all the same finds some of what it would, and the closest interface is that of a phase that is not opaque. So
     * do not pass their crossings by filters; and they must be shown. Not the vacuum. */
    PhasetreePhaseSet opaquePhases;
    /* Asked now and then while cells are built, by any thread; true ends the call with PHASETREE_ERROR_CANCELLED.
     * NULL: never asked. Used during the call only. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
    /* Told how much of the cells is built, from 0 to 1: never less than before, and 1 once they are complete, which
     * leaves Embree's tree over them to be built. The shares are estimates. As Embree's own progress monitor's: true
     * goes on; false ends the call with PHASETREE_ERROR_CANCELLED, and it is not called again. Called by any thread
     * that builds, but by one at a time, which the others then wait for: return soon, and call nothing that builds.
     * NULL: nobody is told. Used during the call only; not at all where cells are read from a file. */
    RTCProgressMonitorFunction progress;
    void* progressUserPtr;
} PhasetreeGeometryOptions;

/* Sets the defaults. */
static inline void phasetreeInitGeometryOptions(PhasetreeGeometryOptions* options) {
    options->flags = PHASETREE_GEOMETRY_FLAG_NONE;
    options->resolution = 0;
    options->buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    options->cellDivisions = 0;
    options->mostBytes = 0;
    options->shownPhases = PHASETREE_ALL_PHASES;
    options->opaquePhases = 0;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
    options->progress = NULL;
    options->progressUserPtr = NULL;
}

/* Makes a geometry of a tree: a snapshot, so the tree may be released at once.
 *
 * device    of the RTCGeometry; retained.
 * options   NULL: the defaults.
 * geometry  receives the new handle.
 *
 * Builds cells and, within Embree, a tree over them, using Embree's and TBB's threads; that is the expensive part, and
 * committing the RTCGeometry costs nothing beside it. Embree's memory monitor sees the memory of Embree's tree. The
 * cells are built by as many threads as Embree's device may have: both take theirs from TBB, whose number the first
 * device's configuration ("threads=") or a tbb::global_control of the application limits for the process.
 *
 * PHASETREE_ERROR_INVALID_TREE  the tree is empty (nothing of it is left, or all is vacuum), or unbounded: it has no
 *                               cells, and the message says so. phasetreeGetTreeBounds tells beforehand.
 * Embree's error code of the calling thread (rtcGetDeviceError) is cleared.
 *
 * A hit of the geometry is a change of phase along a ray:
 *     tfar         where the phase ends that the ray is in
 *     Ng           the interface's normal on the side the ray comes from, of unit length; in geometry space
 *     u, v         index of the phase left and of the phase entered
 *     primID       the cell
 *     geomID, instID, instPrimID   as always
 * The phase that a ray is in is the one at its start, at tnear, unless the ray's context says otherwise
 * (PhasetreeRayContext). Directions may have any length. Rays with numbers that are not finite hit nothing.
 *
 * Filter functions of the RTCGeometry and, with Embree 3, of the context are called for each crossing of shown phases
 * on the ray, in the order of the ray, each once, until one is accepted; the phases of consecutive calls follow on each
 * other. geometryUserPtr is the pointer of phasetreeSetGeometryUserData. With Embree 4 a filter function among a
 * query's arguments cannot be seen by any user geometry; give it as PhasetreeRayContext.filter instead.
 *
 * OWNERSHIP. Embree tells nobody when it destroys a geometry. So: *the handle must live for as long as a scene that
 * the RTCGeometry is attached to is committed or traced*; release it after the scene. If it is freed earlier, the
 * RTCGeometry is empty from then on: nothing is hit, and nothing crashes unless a ray is inside just then. The handle
 * holds one reference of the RTCGeometry; Embree's scenes hold their own. */
PHASETREE_API PhasetreeError phasetreeNewGeometry(unsigned int apiVersion, RTCDevice device, PhasetreeTree tree,
                                                  const PhasetreeGeometryOptions* options, PhasetreeGeometry* geometry);

/* Adds a reference to a geometry, or takes one away: the last one frees it. When that may be, phasetreeNewGeometry
 * tells. */
PHASETREE_API PhasetreeError phasetreeRetainGeometry(PhasetreeGeometry geometry);
PHASETREE_API PhasetreeError phasetreeReleaseGeometry(PhasetreeGeometry geometry);

/* The RTCGeometry: of type RTC_GEOMETRY_TYPE_USER, not committed, and with one primitive (or one for each cell:
 * PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES). It belongs to the handle;
 * attach it (scenes add a reference), rtcRetainGeometry it if it shall outlive the handle. Everything may be called on
 * it but what would replace the library's own settings: rtcSetGeometryUserData (use phasetreeSetGeometryUserData),
 * rtcSetGeometryUserPrimitiveCount, TimeStepCount, TimeRange (use phasetreeSetGeometryMotion), BoundsFunction,
 * IntersectFunction, OccludedFunction. Whoever sets another user pointer all the same has an empty geometry. */
PHASETREE_API PhasetreeError phasetreeGetEmbreeGeometry(PhasetreeGeometry geometry, RTCGeometry* embreeGeometry);

/* The handle of an RTCGeometry that this library made, without a reference of its own; INVALID_HANDLE for any other.
 * With it an application finds the geometry of a hit: rtcGetGeometry(scene, hit.geomID). */
PHASETREE_API PhasetreeError phasetreeGetGeometryFromEmbree(RTCGeometry embreeGeometry, PhasetreeGeometry* geometry);

/* The application's own pointer, NULL at first; the library never looks at what it points to. Filter functions get it
 * as geometryUserPtr. Setting it is exclusive. */
PHASETREE_API PhasetreeError phasetreeSetGeometryUserData(PhasetreeGeometry geometry, void* userPtr);
PHASETREE_API PhasetreeError phasetreeGetGeometryUserData(PhasetreeGeometry geometry, void** userPtr);

/* Keep an application's own number and pointer for each phase, 0 and NULL at first: which material of its own it is,
 * say. The library never looks at them. They stay when the geometry gets another tree, and go by the phase's index, 0 …
 * PHASETREE_MAX_PHASES − 1, whether the tree has it or not. Either output may be NULL. Setting is exclusive. */
PHASETREE_API PhasetreeError phasetreeSetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase,
                                                               int64_t userInteger, void* userPtr);
PHASETREE_API PhasetreeError phasetreeGetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase,
                                                               int64_t* userInteger, void** userPtr);

/* Edits: gives the geometry another tree, or an edited one. Exclusive. Everything is built anew within the call, as by
 * phasetreeNewGeometry; what was there before stays in use if the call fails. The options' flags are not looked at.
 *
 * The RTCGeometry is then as after any modification: rtcCommitGeometry it, and rtcCommitScene each scene that has it,
 * before they are traced again. It has one primitive as before, so a scene with RTC_BUILD_QUALITY_REFIT on the geometry
 * refits. With PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES it has other primitives than before, and must be built anew. */
PHASETREE_API PhasetreeError phasetreeSetGeometryTree(PhasetreeGeometry geometry, PhasetreeTree tree,
                                                      const PhasetreeGeometryOptions* options);

/* Changes the phases to show: see PhasetreeGeometryOptions.shownPhases. Exclusive; nothing need be committed.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT   an opaque phase is not among them
 * PHASETREE_ERROR_INVALID_OPERATION  any phase is not, and the geometry has PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES */
PHASETREE_API PhasetreeError phasetreeSetGeometryShownPhases(PhasetreeGeometry geometry, PhasetreePhaseSet shownPhases);

/* Places the geometry, and moves it: linear motion blur of the whole.
 *
 * transforms     timeStepCount matrices from the tree's space to geometry space, one after another, each of 12 floats,
 *                3×4 column-major (RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR); affine and invertible. Copied. Between time steps
 *                their entries are interpolated linearly, as Embree does with instances: use enough steps for a
 *                rotation; two that are half a turn apart pass through a matrix without inverse, where nothing is hit.
 * timeStepCount  1 … RTC_MAX_TIME_STEP_COUNT; 1: the object is placed and does not move. 0 (transforms NULL): the
 *                tree's own space, as at first.
 * startTime, endTime   the time of the first and of the last step, in the unit of the rays' time, where 0 … 1 is the
 *                camera's shutter; endTime > startTime, and a millionth of what is between them is in the shutter.
 *                Outside of them the object stays at the first or last step's place where Embree lets rays see it at
 *                all (rtcSetGeometryTimeRange).
 *
 * Exclusive. Nothing is rebuilt: commit the RTCGeometry, with one primitive, and the scene.
 *
 * PHASETREE_ERROR_INVALID_OPERATION  the geometry has PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES: put it in an instance */
PHASETREE_API PhasetreeError phasetreeSetGeometryMotion(PhasetreeGeometry geometry, const float* transforms,
                                                        unsigned int timeStepCount, float startTime, float endTime);

/* Writes the geometry's cells to a file, which phasetreeNewGeometryFromCells reads in much less time than building
 * takes.
 *
 * path  UTF-8, ends with 0. The file appears whole or not at all, under a temporary name in its folder before; what was
 *       there is replaced.
 *
 * PHASETREE_ERROR_CELLS_FILE  it cannot be written; the message has the system's reason */
PHASETREE_API PhasetreeError phasetreeWriteGeometryCells(PhasetreeGeometry geometry, const char* path);

/* Makes a geometry as phasetreeNewGeometry does, with cells from a file instead of built ones; to the last bit those
 * that would be built. Embree's tree over them is built as always.
 *
 * tree, options  those that the cells were built for: the same shapes (names and materials do not matter), resolution,
 *                buildQuality, cellDivisions and opaquePhases. What else is in the options may differ.
 *
 * PHASETREE_ERROR_CELLS_FILE  there is no such file; it is something else, or damaged (its size, its checksums and all
 *                             indices in it are looked at); or its cells are those of another tree, of other options,
 *                             of another build of the library or for another kind of machine. The message says which.
 *                             Build then, and write the file anew.
 *
 * The file is for the machine's processor architecture and byte order; its instruction set (SSE2 … AVX-512) does not
 * matter. The checksums find accidents and not forgery: a forged file may hold a wrong object, though none that makes a
 * ray read memory that it should not. */
PHASETREE_API PhasetreeError phasetreeNewGeometryFromCells(unsigned int apiVersion, RTCDevice device,
                                                           PhasetreeTree tree, const PhasetreeGeometryOptions* options,
                                                           const char* path, PhasetreeGeometry* geometry);

/* What was built of a geometry. */
typedef struct PhasetreeGeometryStatistics {
    size_t cells; /* primIDs of hits are below this */
    size_t bytes; /* of the cells and their programs, without Embree's tree over them */
    size_t wholeInstructions, medianInstructions, mostInstructions; /* of the whole object's program, and of cells' */
    float resolution;                                               /* a distance, in the tree's space */
    float buildSeconds;                                             /* of the cells, or to read them */
} PhasetreeGeometryStatistics;

/* Tells what was built of a geometry, and how long that took. */
PHASETREE_API PhasetreeError phasetreeGetGeometryStatistics(PhasetreeGeometry geometry,
                                                            PhasetreeGeometryStatistics* statistics);

/* A sentence for people if the tree lies so far from the origin for its size that 32-bit coordinates leave few digits,
 * or if another resolution is used than the options asked for; else "". UTF-8; belongs to the geometry, until
 * phasetreeSetGeometryTree. A tree that is too far to be traced at all is refused with PHASETREE_ERROR_INVALID_TREE. */
PHASETREE_API PhasetreeError phasetreeGetGeometryWarning(PhasetreeGeometry geometry, const char** warning);

#if defined(__cplusplus)
}
#endif

#endif
