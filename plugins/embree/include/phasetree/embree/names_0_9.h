/* Member and function names of version 0.9, for code that was written for it. Include this header last: its macros
 * replace every later use of these words. */
#ifndef PHASETREE_EMBREE_NAMES_0_9_H
#define PHASETREE_EMBREE_NAMES_0_9_H

#include "phasetree/phasetree_embree.h"

/* hit.h */
#define PhasetreeMedium PhasetreeCarriedPhase
#define media carried
#define mediumCount carriedCount
#define phaseLeft from
#define phaseEntered to
#define phasetreeGetPhaseLeft phasetreeGetHitFrom
#define phasetreeGetPhaseEntered phasetreeGetHitTo

/* hit.h and precise.h */
#define tIn tFrom
#define tOut tTo
#define pointIn pointFrom
#define pointOut pointTo

/* point.h */
#define here from
#define there to

#endif
