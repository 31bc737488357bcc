/* Measuring and proving. phasetreeMeasureTree computes volumes, masses and moments of a tree's phases, each as an
 * interval that is guaranteed to contain the value. phasetreeProveStatements proves or refutes statements about a tree.
 * Neither needs Embree. See phasetree_embree.h for the conventions, and phasetree/measuring/measure.hpp and prove.hpp
 * for the guarantees. */
#ifndef PHASETREE_EMBREE_MEASURE_H
#define PHASETREE_EMBREE_MEASURE_H

#include <math.h>

#include "phasetree/embree/geometry.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* Both calls use the threads of TBB's default arena. Results do not depend on their number, unless time ends a call or
 * the application cancels it. Lengths are in the tree's unit, volumes in this unit cubed. */

/* A number that is guaranteed to lie between low and high, and an estimate of it. */
typedef struct PhasetreeMeasured {
    double low, high, estimate;
} PhasetreeMeasured;

/* The integrals over a body of constant density, or over several bodies. */
typedef struct PhasetreeBody {
    PhasetreeMeasured volume;
    PhasetreeMeasured mass; /* the density times the volume; without a density, the volume */
    /* The centre of mass, and the tensor of inertia about it: xx, yy, zz, xy, xz, yz. Infinite intervals if the volume
     * may be 0. */
    PhasetreeMeasured centre[3];
    PhasetreeMeasured inertia[6];
} PhasetreeBody;

/* The measures of a phase. */
typedef struct PhasetreeMeasuredPhase {
    PhasetreeBody body;
    /* The phase's bounding box: its lowest and highest coordinates along x, y and z. Infinite intervals if the phase
     * may be empty. */
    PhasetreeMeasured boxLow[3], boxHigh[3];
} PhasetreeMeasuredPhase;

/* Why measuring ended. */
typedef enum PhasetreeMeasureEnd {
    PHASETREE_MEASURE_END_TOLERANCE = 0, /* all volumes are as precise as requested */
    PHASETREE_MEASURE_END_PRECISION = 1, /* 32-bit coordinates allow no narrower intervals */
    PHASETREE_MEASURE_END_SECONDS = 2,   /* options->seconds */
    PHASETREE_MEASURE_END_BOXES = 3,     /* options->maxBoxes */
    PHASETREE_MEASURE_END_CANCELLED = 4  /* options->cancelled returned true */
} PhasetreeMeasureEnd;

/* Options of phasetreeMeasureTree. Initialise them with phasetreeInitMeasureOptions. */
typedef struct PhasetreeMeasureOptions {
    /* Measuring ends once the interval of each volume is no wider than this fraction of the volume, or of a thousandth
     * of the object's volume if that is more. Positive. */
    double tolerance;
    double seconds;  /* measuring ends after this time; HUGE_VAL for no limit. Positive */
    size_t maxBoxes; /* measuring divides the object into boxes, and ends after about this many */
    /* A density for each of the tree's phases, the vacuum included, in units of mass per cubed unit of length; NaN for
     * a phase without one. NULL if no phase has one. The densities in a scene file are not used. */
    const double* densities;
    /* Polled from any thread; return true to stop with the results so far. May be NULL. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
    /* Receives an estimate of the fraction done, increasing up to 1. Called from one thread at a time. May be NULL. */
    void (*progress)(void* userPtr, double fraction);
    void* progressUserPtr;
} PhasetreeMeasureOptions;

/* Sets the defaults. */
static inline void phasetreeInitMeasureOptions(PhasetreeMeasureOptions* options) {
    options->tolerance = 1e-3;
    options->seconds = HUGE_VAL;
    options->maxBoxes = (size_t)1 << 26;
    options->densities = NULL;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
    options->progress = NULL;
    options->progressUserPtr = NULL;
}

/* Measures all phases of a tree.
 *
 * options  NULL for the defaults.
 * phases   receives one element for each of the tree's phases (phasetreeGetTreePhaseCount). For the vacuum, only the
 *          volume is set, to that of the vacuum in a box around the object. A phase that the tree does not use has the
 *          volume 0.
 * all      receives the phases with densities as one body; all members are 0 if there are none. May be NULL.
 * end      receives the reason for the end. May be NULL.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT  the tolerance or the time is not positive, or a density is negative or infinite
 * PHASETREE_ERROR_INVALID_TREE      the tree is empty or unbounded, or too far from the origin for its size */
PHASETREE_API PhasetreeError phasetreeMeasureTree(PhasetreeTree tree, const PhasetreeMeasureOptions* options,
                                                  PhasetreeMeasuredPhase* phases, PhasetreeBody* all,
                                                  PhasetreeMeasureEnd* end);

/* Kinds of statements. A statement about an empty phase is refuted. */
typedef enum PhasetreeStatementKind {
    PHASETREE_STATEMENT_PRESENT = 0,       /* some point has this phase */
    PHASETREE_STATEMENT_CONNECTED = 1,     /* the phase is in one piece */
    PHASETREE_STATEMENT_CLOSED = 2,        /* every path from `inside` to the outside crosses one of `phases` */
    PHASETREE_STATEMENT_APART = 3,         /* the two phases do not touch, and are at least atLeast apart */
    PHASETREE_STATEMENT_TOUCHING = 4,      /* the two phases touch somewhere */
    PHASETREE_STATEMENT_WALL = 5,          /* the phase is nowhere thinner than atLeast */
    PHASETREE_STATEMENT_VOLUME = 6,        /* the sum of volumes times weights is from atLeast to atMost */
    PHASETREE_STATEMENT_NO_DEAD_NODES = 7, /* removing any node changes the phase of some point */
    /* the bounding box computed from the tree's nodes is at most atMost times as long along each axis as the object */
    PHASETREE_STATEMENT_TIGHT_BOUNDS = 8
} PhasetreeStatementKind;

/* A statement about a tree. Initialise it with phasetreeInitStatement. Members that a kind does not mention are
 * ignored. */
typedef struct PhasetreeStatement {
    PhasetreeStatementKind kind;
    /* The phases that the statement is about: one for PRESENT, CONNECTED and WALL; two for APART and TOUCHING; any
     * number for VOLUME and for CLOSED, where they are the walls. */
    PhasetreePhaseSet phases;
    PhasetreePhaseSet inside; /* CLOSED: the phases inside the walls */
    double atLeast, atMost;   /* APART and WALL: a distance, atLeast; VOLUME: both limits; TIGHT_BOUNDS: atMost */
    /* WALL: every point of the phase must be within this distance of the centre of a ball of diameter atLeast that lies
     * in the phase. 0 selects atLeast; other values must be more than half of it. */
    double reach;
    /* VOLUME: a weight, such as a density, for each of the tree's phases; not negative. NULL for 1. */
    const double* weights;
} PhasetreeStatement;

/* Sets a kind and its phases, no limits, and defaults for the other members. */
static inline void phasetreeInitStatement(PhasetreeStatement* statement, PhasetreeStatementKind kind,
                                          PhasetreePhaseSet phases) {
    statement->kind = kind;
    statement->phases = phases;
    statement->inside = 0;
    statement->atLeast = 0;
    statement->atMost = HUGE_VAL;
    statement->reach = 0;
    statement->weights = NULL;
}

/* Verdicts. */
typedef enum PhasetreeVerdict {
    PHASETREE_VERDICT_PROVED = 0,
    PHASETREE_VERDICT_REFUTED = 1,
    PHASETREE_VERDICT_UNDECIDED = 2
} PhasetreeVerdict;

/* A point, and its phase, which is proven. */
typedef struct PhasetreeWitness {
    float point[3];
    unsigned int phase;
} PhasetreeWitness;

/* The size of PhasetreeProof.reason, including the null terminator. */
#define PHASETREE_REASON_BYTES 128

/* The verdict on a statement, and its reasons. */
typedef struct PhasetreeProof {
    PhasetreeVerdict verdict;
    char reason[PHASETREE_REASON_BYTES]; /* why, in words; cut off if it is longer. "" if there is nothing to add */
    double resolution;                   /* the side of the smallest boxes that were examined */
    PhasetreeMeasured measured;          /* VOLUME: the sum; otherwise 0 */
    /* The points that show the verdict are witnesses firstWitness … firstWitness + witnessCount − 1. */
    size_t firstWitness, witnessCount;
} PhasetreeProof;

/* Options of phasetreeProveStatements. Initialise them with phasetreeInitProveOptions. */
typedef struct PhasetreeProveOptions {
    /* The side of the smallest boxes; smaller features stay undecided. 0 selects 1/256 of the longest side
     * of the object's bounds. */
    double resolution;
    double seconds;  /* time limit, after which open statements stay undecided; HUGE_VAL for none. Positive */
    size_t maxBoxes; /* maximum number of boxes of each subdivision; statements still open then stay undecided */
    /* Polled from any thread; return true to stop with the results so far. May be NULL. */
    bool (*cancelled)(void* userPtr);
    void* cancelledUserPtr;
    /* Receives an estimate of the fraction done. Called from one thread at a time. May be NULL. */
    void (*progress)(void* userPtr, double fraction);
    void* progressUserPtr;
} PhasetreeProveOptions;

/* Sets the defaults. */
static inline void phasetreeInitProveOptions(PhasetreeProveOptions* options) {
    options->resolution = 0;
    options->seconds = HUGE_VAL;
    options->maxBoxes = (size_t)1 << 25;
    options->cancelled = NULL;
    options->cancelledUserPtr = NULL;
    options->progress = NULL;
    options->progressUserPtr = NULL;
}

/* Decides statements about a tree. A proved statement holds everywhere, not only at sampled points.
 *
 * statements    `count` of them.
 * options       NULL for the defaults.
 * proofs        receives `count` proofs.
 * witnesses     receives the points that show the verdicts, up to witnessCapacity. May be NULL if that is 0. The path
 *               that refutes a CLOSED statement may have hundreds of points.
 * witnessCount  receives the number of all points, which may exceed witnessCapacity. May be NULL.
 *
 * PHASETREE_ERROR_INVALID_ARGUMENT  a statement is invalid, or an option out of its range. The message names the
 *                                   statement.
 * PHASETREE_ERROR_INVALID_TREE      the tree is empty or unbounded, or too far from the origin for its size */
PHASETREE_API PhasetreeError phasetreeProveStatements(PhasetreeTree tree, const PhasetreeStatement* statements,
                                                      size_t count, const PhasetreeProveOptions* options,
                                                      PhasetreeProof* proofs, PhasetreeWitness* witnesses,
                                                      size_t witnessCapacity, size_t* witnessCount);

#if defined(__cplusplus)
}
#endif

#endif
