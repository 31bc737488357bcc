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

#include <stddef.h>
#include <stdint.h>

#if !defined(RTC_VERSION_MAJOR)
#if PHASETREE_EMBREE_MAJOR == 4
#include <embree4/rtcore.h>
#elif PHASETREE_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#error "define PHASETREE_EMBREE_MAJOR as 3 or 4, or include Embree's rtcore.h before this header"
#endif
#endif

#if defined(__cplusplus)
extern "C" {
#endif

#if defined(__GNUC__)
#define PHASETREE_API __attribute__((visibility("default")))
#else
#define PHASETREE_API
#endif

/* The interface's version, 100 · the interface's number + Embree's major version. Structures and calls of one number
 * never change. An application passes PHASETREE_API_VERSION where a call has a parameter apiVersion; a library that
 * does not serve that number, or serves the other Embree, answers PHASETREE_ERROR_VERSION. */
#define PHASETREE_API_NUMBER 1
#define PHASETREE_API_VERSION (100 * PHASETREE_API_NUMBER + RTC_VERSION_MAJOR)

/* Phases have the indices 0 … PHASETREE_MAX_PHASES − 1; 0 is the vacuum, around and within every object. */
#define PHASETREE_MAX_PHASES 64
#define PHASETREE_VACUUM 0u
/* No phase known: see PhasetreeMedium. */
#define PHASETREE_UNKNOWN_PHASE 0xffffffffu

typedef struct PhasetreeTreeHandle* PhasetreeTree;
typedef struct PhasetreeGeometryHandle* PhasetreeGeometry;

typedef enum PhasetreeError {
    PHASETREE_ERROR_NONE = 0,
    PHASETREE_ERROR_INVALID_HANDLE = 1,   /* NULL, freed, of another kind, or not ours at all */
    PHASETREE_ERROR_INVALID_ARGUMENT = 2, /* a value that the call's documentation excludes */
    PHASETREE_ERROR_INVALID_TREE = 3,     /* a scene file or text that is wrong: the message has file, line, column */
    PHASETREE_ERROR_INVALID_OPERATION = 4, /* not now: a hit that is no hit, an instance inside a query without one … */
    PHASETREE_ERROR_VERSION = 5,           /* see PHASETREE_API_VERSION */
    PHASETREE_ERROR_CANCELLED = 6,         /* by PhasetreeGeometryOptions.cancelled or Embree's memory monitor */
    PHASETREE_ERROR_OUT_OF_MEMORY = 7,
    PHASETREE_ERROR_EMBREE = 8, /* Embree refused; the message has its error's name */
    PHASETREE_ERROR_UNKNOWN = 9
} PhasetreeError;

/* The version of the library that is linked, as PHASETREE_API_VERSION. */
PHASETREE_API unsigned int phasetreeGetApiVersion(void);

/* What was wrong with the last call of *this thread* that failed, for a person, in UTF-8, without a newline at its end;
 * "" if none has. Good until the next call of this thread that fails, or the thread's end. */
PHASETREE_API const char* phasetreeGetErrorMessage(void);

/* ------------------------------------------------------------------------------------------------------------------
 * Trees
 * --------------------------------------------------------------------------------------------------------------- */

/* Where PhasetreeFileReader.readImage puts an image: only within that call. */
typedef struct PhasetreeImageSink* PhasetreeImage;

/* Sets an image's size in pixels and returns room for its width·height values, owned by the library: rows from the top,
 * each value from 0 (low) to 1 (high). NULL if a size is 0, above 32768, or memory is short. */
PHASETREE_API float* phasetreeNewImageValues(PhasetreeImage image, unsigned int width, unsigned int height);

/* How height maps are read, the only images that trees name; the library itself reads none. readImage is called during
 * the calls that it is given to and on their thread: it opens the file (path is UTF-8, already relative to the working
 * directory, not to the scene), asks phasetreeNewImageValues for room, fills it and returns NULL; or it returns what
 * is wrong with the file, a text that must stay good until the call is over. userPtr is handed through. */
typedef struct PhasetreeFileReader {
    const char* (*readImage)(void* userPtr, const char* path, PhasetreeImage image);
    void* userPtr;
} PhasetreeFileReader;

/* Reads a tree from a scene file (JSON; what the file says besides "phases", "shapes" and "tree" is not looked at).
 *
 * path    UTF-8, ends with 0.
 * reader  NULL if no images are to be read; a scene with a height map is then an error. Copied; what its userPtr points
 *         to must live as long as the tree or any tree edited from it, because edits read again.
 * tree    receives the new handle.
 *
 * Files that the scene names are sought beside it. All of them are read during the call. */
PHASETREE_API PhasetreeError phasetreeNewTreeFromFile(unsigned int apiVersion, const char* path,
                                                      const PhasetreeFileReader* reader, PhasetreeTree* tree);

/* The same from a text in memory.
 *
 * text    UTF-8, `length` bytes; need not end with 0. Copied.
 * name    what errors call it, and, taken for a path, beside what files are sought; NULL: "<text>" and the working
 *         directory. */
PHASETREE_API PhasetreeError phasetreeNewTreeFromText(unsigned int apiVersion, const char* text, size_t length,
                                                      const char* name, const PhasetreeFileReader* reader,
                                                      PhasetreeTree* tree);

/* A new tree: `tree` with one value of its scene text replaced. `tree` itself stays as it is, for whoever uses it.
 *
 * path    a JSON Pointer (RFC 6901) to a value within the text: "/shapes/bulb/sphere/radius", "/tree/under/0". A value
 *         in a named shape changes wherever the shape is used.
 * value   the new value as JSON, ends with 0: "0.5", "[1, 0, 0]", "\"glass\"", or a whole subtree.
 *
 * Errors are told at the edited text's lines and columns. The text is read again, with the files that it names. */
PHASETREE_API PhasetreeError phasetreeNewEditedTree(PhasetreeTree tree, const char* path, const char* value,
                                                    PhasetreeTree* edited);

PHASETREE_API PhasetreeError phasetreeRetainTree(PhasetreeTree tree);
PHASETREE_API PhasetreeError phasetreeReleaseTree(PhasetreeTree tree);

/* How many phases the scene names, the vacuum included: the tree's phases are 0 … count − 1. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseCount(PhasetreeTree tree, unsigned int* count);

/* A phase's name, "vacuum" for 0. UTF-8; belongs to the tree and lives as long. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseName(PhasetreeTree tree, unsigned int phase, const char** name);

/* A phase's index by its name; INVALID_ARGUMENT if there is none of that name. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseByName(PhasetreeTree tree, const char* name, unsigned int* phase);

/* A box around everything that is not vacuum; infinite where the tree is. */
PHASETREE_API PhasetreeError phasetreeGetTreeBounds(PhasetreeTree tree, struct RTCBounds* bounds);

/* ------------------------------------------------------------------------------------------------------------------
 * Geometries
 * --------------------------------------------------------------------------------------------------------------- */

/* A set of phases: bit i stands for the phase i. */
typedef uint64_t PhasetreePhaseSet;
#define PHASETREE_ALL_PHASES (~(PhasetreePhaseSet)0)

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
    PHASETREE_GEOMETRY_FLAG_POINT_QUERY = 1 << 2
} PhasetreeGeometryFlags;

/* What phasetreeNewGeometry and phasetreeSetGeometryTree may be told; start from phasetreeInitGeometryOptions. */
typedef struct PhasetreeGeometryOptions {
    unsigned int flags; /* PhasetreeGeometryFlags; what phasetreeSetGeometryTree is told of them it does not look at */
    /* A distance: brackets are no longer, and what is thinner along a ray may be passed. 0: 2·10⁻⁶ of the diagonal of
     * the tree's bounds, or what 32-bit coordinates allow where the tree is far from the origin. */
    float resolution;
    /* Cells are the boxes into which the object is cut: a box is divided if that may save its rays this share of the
     * time that they need at least (a small box, of which there are many, only for more), and at most so many times from
     * the bounds on (20 or fewer). Fewer and larger cells build faster and trace slower. 0: the library's choice. */
    float cellGain;
    unsigned int cellDivisions;
    /* Phases to show: a crossing between two phases of which none is in the set is passed as if it were not there. The
     * vacuum never counts as shown, in the set or not. To hide one phase, leave it out. */
    PhasetreePhaseSet shownPhases;
    /* Asked now and then while cells are built, by any thread; true ends the call with PHASETREE_ERROR_CANCELLED.
     * NULL: never asked. Used during the call only. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
} PhasetreeGeometryOptions;

static inline void phasetreeInitGeometryOptions(PhasetreeGeometryOptions* options) {
    options->flags = PHASETREE_GEOMETRY_FLAG_NONE;
    options->resolution = 0;
    options->cellGain = 0;
    options->cellDivisions = 0;
    options->shownPhases = PHASETREE_ALL_PHASES;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
}

/* Makes a geometry of a tree: a snapshot, so the tree may be released at once.
 *
 * device    of the RTCGeometry; retained.
 * options   NULL: the defaults.
 * geometry  receives the new handle.
 *
 * Builds cells and, within Embree, a tree over them, using Embree's and TBB's threads; that is the expensive part, and
 * committing the RTCGeometry costs nothing beside it. Embree's memory monitor sees the memory of Embree's tree.
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

PHASETREE_API PhasetreeError phasetreeRetainGeometry(PhasetreeGeometry geometry);
PHASETREE_API PhasetreeError phasetreeReleaseGeometry(PhasetreeGeometry geometry);

/* The RTCGeometry: of type RTC_GEOMETRY_TYPE_USER, with one primitive, and not committed. It belongs to the handle;
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

/* Edits: gives the geometry another tree, or an edited one. Exclusive. Everything is built anew within the call, as by
 * phasetreeNewGeometry; what was there before stays in use if the call fails. The options' flags are not looked at.
 *
 * The RTCGeometry is then as after any modification: rtcCommitGeometry it, and rtcCommitScene each scene that has it,
 * before they are traced again. It has one primitive as before, so a scene with RTC_BUILD_QUALITY_REFIT on the geometry
 * refits. */
PHASETREE_API PhasetreeError phasetreeSetGeometryTree(PhasetreeGeometry geometry, PhasetreeTree tree,
                                                      const PhasetreeGeometryOptions* options);

/* Changes the phases to show: see PhasetreeGeometryOptions.shownPhases. Exclusive; nothing need be committed. */
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
 *                camera's shutter; endTime > startTime. Outside of them the object stays at the first or last step's
 *                place where Embree lets rays see it at all (rtcSetGeometryTimeRange).
 *
 * Exclusive. Nothing is rebuilt: commit the RTCGeometry, with one primitive, and the scene. */
PHASETREE_API PhasetreeError phasetreeSetGeometryMotion(PhasetreeGeometry geometry, const float* transforms,
                                                        unsigned int timeStepCount, float startTime, float endTime);

typedef struct PhasetreeGeometryStatistics {
    size_t cells; /* primIDs of hits are below this */
    size_t bytes; /* of the cells and their programs, without Embree's tree over them */
    size_t wholeInstructions, medianInstructions, mostInstructions; /* of the whole object's program, and of cells' */
    float resolution;                                               /* a distance, in the tree's space */
    float buildSeconds;                                             /* of the cells */
} PhasetreeGeometryStatistics;

PHASETREE_API PhasetreeError phasetreeGetGeometryStatistics(PhasetreeGeometry geometry,
                                                            PhasetreeGeometryStatistics* statistics);

/* ------------------------------------------------------------------------------------------------------------------
 * Hits
 * --------------------------------------------------------------------------------------------------------------- */

/* A crossing: a change of phase on a ray, bracketed by two places of which each has been evaluated and has its phase.
 * The bracket is no longer than the resolution, or up to 2.7 of them where rounding puts a third phase between solids
 * that abut. A ray that is reflected goes on from pointIn in phaseLeft, one that passes from pointOut in phaseEntered;
 * nothing needs to be moved along a normal, and it meets this crossing no more if it carries that phase. */
typedef struct PhasetreeHit {
    unsigned int phaseLeft, phaseEntered;
    unsigned int cell;
    float tIn, tOut;               /* on the ray */
    float pointIn[3], pointOut[3]; /* in geometry space */
} PhasetreeHit;

/* The phases of hit i among N, within a filter function (C has none of Embree's accessors) or anywhere else: the one that
 * the ray leaves, and the one that it enters. Only for hits of a phasetree geometry. */
static inline unsigned int phasetreeGetPhaseLeft(const struct RTCHitN* hits, unsigned int N, unsigned int i) {
    return (unsigned int)((const float*)hits)[3 * N + i];
}
static inline unsigned int phasetreeGetPhaseEntered(const struct RTCHitN* hits, unsigned int N, unsigned int i) {
    return (unsigned int)((const float*)hits)[4 * N + i];
}

/* Tells what a stock ray query has found.
 *
 * rayhit       as the query left it: the ray's origin, direction, tnear and time, tfar and the hit, which must be one
 *              of this geometry.
 * objectToWorld  of the instance through which the ray met the geometry, 12 floats, 3×4 column-major, at the ray's time
 *              (for nested ones the product); NULL if hit.instID[0] is RTC_INVALID_GEOMETRY_ID.
 *
 * The bracket is found again, by a few samples on the ray around tfar. tOut and pointOut are moved on, by less than two
 * resolutions, to where the phase is certain in spite of the rounding that a new ray undergoes: the same ray with
 * tnear = tOut starts in phaseEntered, so that a host that carries no phases neither meets this crossing again nor
 * passes the next one, as long as phases are thicker along the ray than some five resolutions. */
PHASETREE_API PhasetreeError phasetreeDecodeHit(PhasetreeGeometry geometry, const struct RTCRayHit* rayhit,
                                                const float* objectToWorld, PhasetreeHit* hit);

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
     * beyond what rounding explains, that is a crossing at the start. Owned by the application; not written. */
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

/* ------------------------------------------------------------------------------------------------------------------
 * Points
 * --------------------------------------------------------------------------------------------------------------- */

/* The phase at a point of the geometry as it stands (hidden phases included), and the radius of a ball around it in
 * which there certainly is no other; the second may be NULL.
 *
 * point  in geometry space; finite numbers.
 * time   of the motion; any number if there is none. */
PHASETREE_API PhasetreeError phasetreeGetPhase(PhasetreeGeometry geometry, const float point[3], float time,
                                               unsigned int* phase, float* emptyRadius);

/* Φ at a point: PHASETREE_MAX_PHASES signed distances, +∞ for phases that the object does not have. The phase is the
 * smallest one's. In the tree's units, also where the geometry is placed with a scale; the point as above. */
PHASETREE_API PhasetreeError phasetreeGetDistances(PhasetreeGeometry geometry, const float point[3], float time,
                                                   float distances[PHASETREE_MAX_PHASES]);

/* What a search for the closest interface has found. */
typedef struct PhasetreeClosest {
    bool found;
    /* No interface is nearer than emptyRadius, guaranteed. An interface is at `point`, at `distance`: between places of
     * phase `here` and of phase `there` that are no farther apart than the resolution. Without `found`, emptyRadius is
     * the radius that was searched and the rest is not set. */
    float emptyRadius;
    float distance;
    float point[3];
    unsigned int here, there; /* `here` is the phase on the side of the query's point, as far as it can be told */
} PhasetreeClosest;

/* The closest interface (of any phases) to a point.
 *
 * point, time   as above.
 * radius        a distance: how far to look; +∞: everywhere.
 * tolerance     how near emptyRadius and distance come to each other before the search ends, as a share of distance:
 *               0.001 … 1; it also ends when they are within four resolutions, and after 2^16 evaluations of sixteen
 *               points at the latest. The larger, the quicker.
 *
 * Searches by branch and bound over the object's cells, in which 1-Lipschitz distances exclude boxes. */
PHASETREE_API PhasetreeError phasetreeFindClosestInterface(PhasetreeGeometry geometry, const float point[3], float time,
                                                           float radius, float tolerance, PhasetreeClosest* closest);

/* Point queries of whole scenes. Embree does not tell a point query's callback whose user pointer is whose, so the
 * application lists the geometries that it wants to be asked. */
typedef struct PhasetreePointQueryGeometry {
    unsigned int geomID, instID; /* instID: of the innermost instance, or RTC_INVALID_GEOMETRY_ID */
    PhasetreeGeometry geometry;
} PhasetreePointQueryGeometry;

typedef struct PhasetreePointQuery {
    unsigned int apiVersion; /* PHASETREE_API_VERSION */
    const PhasetreePointQueryGeometry* geometries;
    unsigned int geometryCount;
    float tolerance; /* see phasetreeFindClosestInterface */
    /* Out: the closest so far, in world space, and whose. closest.found must be false at first. emptyRadius is not set:
     * interfaces of the listed geometries nearer than distance·(1 − tolerance), or if nothing was found than the
     * query's radius, there are none. */
    PhasetreeClosest closest;
    unsigned int geomID, instID;
} PhasetreePointQuery;

/* For rtcPointQuery: as its callback, or registered with geometries (PHASETREE_GEOMETRY_FLAG_POINT_QUERY). The query's
 * user pointer is a PhasetreePointQuery. Shrinks the query's radius to the distance found, as Embree wants it, so that
 * it goes well with an application's own callbacks for meshes, called from one that dispatches by geomID. Works within
 * instances of any affine transform. */
PHASETREE_API bool phasetreePointQueryFunction(struct RTCPointQueryFunctionArguments* args);

/* ------------------------------------------------------------------------------------------------------------------
 * Callbacks, for applications that dispatch between geometries of their own
 * --------------------------------------------------------------------------------------------------------------- */

/* What phasetreeNewGeometry registers with Embree. geometryUserPtr is the PhasetreeGeometry. */
PHASETREE_API void phasetreeBoundsFunction(const struct RTCBoundsFunctionArguments* args);
PHASETREE_API void phasetreeIntersectFunction(const struct RTCIntersectFunctionNArguments* args);
PHASETREE_API void phasetreeOccludedFunction(const struct RTCOccludedFunctionNArguments* args);

/* The same for a primitive of an RTCGeometry that is the application's own: from its callbacks it calls these with the
 * handle, and the arguments just as Embree gave them (Embree keeps more behind them than it tells; a copy will not do).
 * primID is not looked at. Filters are those of the application's RTCGeometry. Handles without references: nothing is
 * hit, and the bounds are empty. */
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
