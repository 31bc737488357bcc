/* Geometries: the RTCGeometry of a tree, its options, edits and motion. See phasetree_embree.h for the conventions. */
#ifndef PHASETREE_EMBREE_GEOMETRY_H
#define PHASETREE_EMBREE_GEOMETRY_H

#include "phasetree/embree/tree.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* A set of phases; bit i stands for phase i. */
typedef uint64_t PhasetreePhaseSet;
#define PHASETREE_ALL_PHASES (~(PhasetreePhaseSet)0)

/* Bits of PhasetreeGeometryOptions.flags. */
typedef enum PhasetreeGeometryFlags {
    PHASETREE_GEOMETRY_FLAG_NONE = 0,
    /* Promises that every ray query that can reach the geometry uses a PhasetreeRayContext as its context. Without this
     * flag, the geometry reads nothing but Embree's own members of a context. */
    PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT = 1 << 0,
    /* Promises that neither the geometry nor any query has a filter function. Filter functions are then not called, and
     * occlusion rays may stop at any crossing instead of the first one along the ray. */
    PHASETREE_GEOMETRY_FLAG_NO_FILTERS = 1 << 1,
    /* Registers phasetreePointQueryFunction with the geometry. Every rtcPointQuery that can reach the geometry must
     * then have a PhasetreePointQuery as its user pointer. */
    PHASETREE_GEOMETRY_FLAG_POINT_QUERY = 1 << 2,
    /* Makes each cell a primitive of the RTCGeometry. Cells are the boxes into which the object is divided (see
     * PhasetreeGeometryOptions.buildQuality). The BVH of the application's scene then contains the cells. Without this
     * flag, the RTCGeometry has a single primitive, which traces rays in an inner scene. Hits are the same with and
     * without the flag.
     * With this flag, rays are up to a third faster, in packets or alone, whether or not they carry phases
     * (PhasetreeRay.carried). The restrictions are:
     *   - NO_FILTERS is required, because a filter function would see some crossings twice; POINT_QUERY is not allowed;
     *   - all phases must be shown;
     *   - the object can only be moved by instances.
     * phasetreeSetGeometryTree changes the number of primitives. The inner scene is still built when it is first
     * needed: by phasetreeFindClosestInterface, or by phasetreeDecodeHit for a hit whose primID does not name its
     * cell. */
    PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES = 1 << 3
} PhasetreeGeometryFlags;

/* Options of phasetreeNewGeometry and phasetreeSetGeometryTree. Initialise them with phasetreeInitGeometryOptions. */
typedef struct PhasetreeGeometryOptions {
    unsigned int flags; /* PhasetreeGeometryFlags; ignored by phasetreeSetGeometryTree */
    /* The maximum length of the bracket around a crossing, in the tree's unit (PhasetreeHit describes an exception). A
     * ray may miss a phase that is thinner than this along the ray. 0 selects 2·10⁻⁶ of the diagonal of the tree's
     * bounds, or 10⁻⁶ of their largest coordinate if that is more. All values are clamped: to at most a hundredth of
     * the diagonal, then to at least 2.5·10⁻⁷ of the diagonal or of the largest coordinate, whichever is more.
     * phasetreeGetGeometryStatistics returns the resolution in use. If it is not the one requested,
     * phasetreeGetGeometryWarning says why. */
    float resolution;
    /* RTCBuildQuality: how finely the object is divided into cells, the boxes in which rays search for interfaces. Each
     * cell has a short program of instructions that evaluates the distances in it. LOW builds in a quarter to three
     * quarters of the time of MEDIUM, but usually makes rays slower; use it for objects that are being edited. MEDIUM
     * and HIGH are equal. Hits do not depend on the quality. */
    unsigned int buildQuality;
    unsigned int cellDivisions; /* maximum depth of the division into cells, at most 20; 0 for the default */
    /* Approximate memory limit in bytes for the cells, Embree's BVH over them, and building both. Cells become coarser
     * to stay below it, which makes rays slower but does not change hits. 0 selects 2 GiB, or a quarter of the memory
     * available to the process if that is less. PhasetreeGeometryStatistics.bytes is the part that the
     * cells and their programs use after the build. */
    size_t maxBytes;
    /* Phases to show. A crossing is skipped if neither of its two phases is in the set. The vacuum never counts as
     * shown. So a phase that is left out disappears, except where it touches a shown phase: there, the surface of the
     * shown phase is hit. */
    PhasetreePhaseSet shownPhases;
    /* Phases that rays never enter because their materials are opaque. Interfaces between two of them are not searched
     * for. A geometry that has only opaque phases therefore builds and traces as fast as a geometry that has just its
     * outer surface. A ray that starts inside an opaque phase finds only some of its interfaces, so filters must not
     * let rays pass into these phases. phasetreeFindClosestInterface ignores interfaces between two of them. Opaque
     * phases must be shown, and may not include the vacuum.
     */
    PhasetreePhaseSet opaquePhases;
    /* Polled from any thread while cells are built; return true to cancel with PHASETREE_ERROR_CANCELLED. May be NULL.
     * Used only during the call. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
    /* Receives an estimate of the fraction of cells built. It never decreases, and is 1 when the cells are complete;
     * Embree's BVH over them is built after that. Return false to cancel with PHASETREE_ERROR_CANCELLED, as with
     * Embree's progress monitor; the function is then not called again. Called from any building thread, one at a time,
     * while the others wait: return quickly, and do not build anything in it. May be NULL. Used only during the call,
     * and not at all if cells are read from a file. */
    RTCProgressMonitorFunction progress;
    void* progressUserPtr;
} PhasetreeGeometryOptions;

/* Sets the defaults. */
static inline void phasetreeInitGeometryOptions(PhasetreeGeometryOptions* options) {
    options->flags = PHASETREE_GEOMETRY_FLAG_NONE;
    options->resolution = 0;
    options->buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    options->cellDivisions = 0;
    options->maxBytes = 0;
    options->shownPhases = PHASETREE_ALL_PHASES;
    options->opaquePhases = 0;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
    options->progress = NULL;
    options->progressUserPtr = NULL;
}

/* Creates a geometry from a tree. The geometry is a snapshot, so the tree may be released at once.
 *
 * device    the device of the RTCGeometry; retained.
 * options   NULL for the defaults.
 * geometry  receives the new handle.
 *
 * Builds cells, and a BVH over them in Embree. This is the expensive part; committing the RTCGeometry is cheap.
 * Embree's memory monitor sees the memory of the BVH. Cells are built with as many threads as Embree's device may use,
 * because both draw their threads from TBB. The first device's configuration ("threads=") or a tbb::global_control of
 * the application limits their number for the whole process.
 *
 * PHASETREE_ERROR_INVALID_TREE  the tree is unbounded, or empty: nothing is left of it, or all of it is vacuum. The
 *                               message says which, and names the nodes that make the tree unbounded. Call
 *                               phasetreeGetTreeBounds to find out beforehand.
 *
 * The call clears Embree's error code of the calling thread (rtcGetDeviceError).
 *
 * A hit is a change of phase along a ray. Embree's members of the ray and the hit are set as follows.
 *     tfar         Where the ray leaves the phase that it is in.
 *     Ng           The interface's unit normal in geometry space. It points to the side that the ray comes from.
 *     u, v         The indices of the phases before (`from`) and after (`to`) the crossing.
 *     primID       The cell.
 *     geomID, instID, instPrimID   As usual.
 * A ray starts in the phase found at tnear, unless its context carries a different one (PhasetreeRayContext).
 * Directions may have any length. Rays whose origin or direction is not finite hit nothing.
 *
 * Filter functions of the RTCGeometry and, in Embree 3, of the context are called for the crossings of shown phases on
 * the ray, once each and in order along the ray, until one is accepted. If all phases are shown, `from` of each
 * crossing is `to` of the previous one. Otherwise, there may be hidden crossings between them. geometryUserPtr is the
 * pointer of phasetreeSetGeometryUserData. Embree 4 does not pass a filter function in the arguments of a query to user
 * geometries; pass it as PhasetreeRayContext.filter instead.
 *
 * OWNERSHIP. *Release the handle after the last commit and trace of every scene that contains the RTCGeometry.* Embree
 * does not notify the library when it destroys a geometry. If the handle is freed earlier, the RTCGeometry becomes
 * empty: rays do not hit it. This is safe unless one of its callbacks is running at that moment. The handle holds one
 * reference to the RTCGeometry; Embree's scenes hold their own. */
PHASETREE_API PhasetreeError phasetreeNewGeometry(unsigned int apiVersion, RTCDevice device, PhasetreeTree tree,
                                                  const PhasetreeGeometryOptions* options, PhasetreeGeometry* geometry);

/* Adds a reference to a geometry, or drops one. Dropping the last reference frees the geometry; see
 * phasetreeNewGeometry for when that is allowed. */
PHASETREE_API PhasetreeError phasetreeRetainGeometry(PhasetreeGeometry geometry);
PHASETREE_API PhasetreeError phasetreeReleaseGeometry(PhasetreeGeometry geometry);

/* Returns the RTCGeometry. It has the type RTC_GEOMETRY_TYPE_USER, is not committed, and has one primitive, or one per
 * cell with PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES.
 *
 * The handle owns it. Attach it to scenes, which add their own references; call rtcRetainGeometry if it must outlive
 * the handle. All of Embree's calls are allowed except those that would replace the library's own settings:
 * rtcSetGeometryUserData (use phasetreeSetGeometryUserData), rtcSetGeometryTimeStepCount and rtcSetGeometryTimeRange
 * (use phasetreeSetGeometryMotion), rtcSetGeometryUserPrimitiveCount, rtcSetGeometryBoundsFunction,
 * rtcSetGeometryIntersectFunction and rtcSetGeometryOccludedFunction. Replacing the user pointer makes the geometry
 * empty. */
PHASETREE_API PhasetreeError phasetreeGetEmbreeGeometry(PhasetreeGeometry geometry, RTCGeometry* embreeGeometry);

/* Returns the handle of an RTCGeometry created by this library, without adding a reference. Any other RTCGeometry gives
 * PHASETREE_ERROR_INVALID_HANDLE. Use it to find the geometry of a hit: rtcGetGeometry(scene, hit.geomID). */
PHASETREE_API PhasetreeError phasetreeGetGeometryFromEmbree(RTCGeometry embreeGeometry, PhasetreeGeometry* geometry);

/* Stores a pointer for the application, initially NULL. The library never dereferences it. Filter functions receive it
 * as geometryUserPtr. Setting it is exclusive. */
PHASETREE_API PhasetreeError phasetreeSetGeometryUserData(PhasetreeGeometry geometry, void* userPtr);
PHASETREE_API PhasetreeError phasetreeGetGeometryUserData(PhasetreeGeometry geometry, void** userPtr);

/* Stores a number and a pointer of the application for each phase, such as its material. They are initially 0 and NULL,
 * and the library never uses them. They belong to the phase index, 0 … PHASETREE_MAX_PHASES − 1,
 * whether or not the tree has that phase, and they survive phasetreeSetGeometryTree. Either output may be NULL. Setting
 * them is exclusive. */
PHASETREE_API PhasetreeError phasetreeSetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase,
                                                               int64_t userInteger, void* userPtr);
PHASETREE_API PhasetreeError phasetreeGetGeometryPhaseUserData(PhasetreeGeometry geometry, unsigned int phase,
                                                               int64_t* userInteger, void** userPtr);

/* Replaces the tree of a geometry, for example by an edited one. Exclusive. Rebuilds everything within the call, like
 * phasetreeNewGeometry; if the call fails, the geometry is unchanged. The flags of the options are ignored.
 *
 * Afterwards, as after any modification, call rtcCommitGeometry, and rtcCommitScene for each scene that contains the
 * geometry, before tracing. The geometry still has one primitive, so a scene can refit it (RTC_BUILD_QUALITY_REFIT).
 * With PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES its primitives change, and the scene must be rebuilt. */
PHASETREE_API PhasetreeError phasetreeSetGeometryTree(PhasetreeGeometry geometry, PhasetreeTree tree,
                                                      const PhasetreeGeometryOptions* options);

/* Sets the phases to show; see PhasetreeGeometryOptions.shownPhases. Exclusive. No commit is needed.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT   an opaque phase is missing from the set
 * PHASETREE_ERROR_INVALID_OPERATION  a phase is missing with PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES */
PHASETREE_API PhasetreeError phasetreeSetGeometryShownPhases(PhasetreeGeometry geometry, PhasetreePhaseSet shownPhases);

/* Sets the transform of the geometry, or its transforms over time for linear motion blur.
 *
 * transforms     timeStepCount matrices from the tree's space to geometry space, 12 floats each, 3×4 column-major
 *                (RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR), affine and invertible. Copied. Entries are interpolated linearly
 *                between time steps, as for Embree's instances, so a rotation needs enough steps. If two steps are half
 *                a turn apart, the matrix halfway between them has no inverse, and nothing is hit.
 * timeStepCount  1 … RTC_MAX_TIME_STEP_COUNT. 1 for a transform without motion; 0, with transforms NULL, to return to
 *                the tree's own space.
 * startTime, endTime   the times of the first and the last step, on the scale of RTCRay.time, where the
 *                shutter is open from 0 to 1.
 *                endTime must be greater than startTime, and at least a millionth of [startTime, endTime] must lie in
 *                [0, 1]. Before startTime and after endTime, the object keeps its first or last transform, but Embree
 *                may hide it from rays then: see rtcSetGeometryTimeRange, which is called with startTime and endTime.
 *
 * Exclusive. Nothing is rebuilt; commit the RTCGeometry and the scene.
 *
 * PHASETREE_ERROR_INVALID_OPERATION  the geometry has PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES; use an instance */
PHASETREE_API PhasetreeError phasetreeSetGeometryMotion(PhasetreeGeometry geometry, const float* transforms,
                                                        unsigned int timeStepCount, float startTime, float endTime);

/* Writes the cells of a geometry to a file. phasetreeNewGeometryFromCells reads them much faster than they are built.
 *
 * path  UTF-8, null-terminated. The file is written under a temporary name in the same folder and then renamed, so it
 *       appears complete or not at all. An existing file is replaced.
 *
 * PHASETREE_ERROR_CELLS_FILE  the file cannot be written; the message has the system's reason */
PHASETREE_API PhasetreeError phasetreeWriteGeometryCells(PhasetreeGeometry geometry, const char* path);

/* Creates a geometry like phasetreeNewGeometry, but reads its cells from a file. The cells are identical to built ones,
 * to the last bit. Embree's BVH over them is built as usual.
 *
 * tree, options  must match those for which the cells were built: the same shapes (names and materials may differ),
 *                resolution, buildQuality, cellDivisions and opaquePhases. maxBytes must not be smaller than it was;
 *                if it made the cells coarser, it must be equal. Other options may differ.
 *
 * PHASETREE_ERROR_CELLS_FILE  the file does not exist, is not a cell file, or is damaged (its size, checksums and
 *                             indices are verified); or it was written for another tree, other options, another build
 *                             of the library or another processor architecture. The message says which. Build the
 *                             geometry, then write the file again.
 *
 * The file depends on the processor architecture and byte order, but not on the instruction set (SSE2 … AVX-512). The
 * checksums detect accidents, not forgery: a forged file can describe a wrong object, but cannot make a ray read memory
 * out of bounds. */
PHASETREE_API PhasetreeError phasetreeNewGeometryFromCells(unsigned int apiVersion, RTCDevice device,
                                                           PhasetreeTree tree, const PhasetreeGeometryOptions* options,
                                                           const char* path, PhasetreeGeometry* geometry);

/* Statistics of a built geometry. */
typedef struct PhasetreeGeometryStatistics {
    size_t cells; /* number of cells; primID of a hit is less than this */
    size_t bytes; /* memory of the cells and their programs, without Embree's BVH */
    size_t wholeInstructions, medianInstructions, maxInstructions; /* whole object; median and maximum over cells */
    float resolution;                                              /* in use; a distance in the tree's space */
    float buildSeconds;                                            /* time to build or read the cells */
} PhasetreeGeometryStatistics;

/* Returns statistics of a built geometry. */
PHASETREE_API PhasetreeError phasetreeGetGeometryStatistics(PhasetreeGeometry geometry,
                                                            PhasetreeGeometryStatistics* statistics);

/* Returns a warning in UTF-8, or "" if there is none. There is a warning in two cases: the tree is so far from the
 * origin, relative to its size, that 32-bit coordinates are coarse; or the resolution in use is not the one requested.
 * The string is valid until phasetreeSetGeometryTree is called or the geometry is freed. (A tree that is too far away
 * to be traced is rejected with PHASETREE_ERROR_INVALID_TREE.) */
PHASETREE_API PhasetreeError phasetreeGetGeometryWarning(PhasetreeGeometry geometry, const char** warning);

#if defined(__cplusplus)
}
#endif

#endif
