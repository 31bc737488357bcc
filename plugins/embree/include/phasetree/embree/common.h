/* What every call uses: Embree's header, the version, phases, handles, errors. The conventions are
 * phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_COMMON_H
#define PHASETREE_EMBREE_COMMON_H

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
#define PHASETREE_API_NUMBER 2
#define PHASETREE_API_VERSION (100 * PHASETREE_API_NUMBER + RTC_VERSION_MAJOR)

/* Phases have the indices 0 … PHASETREE_MAX_PHASES − 1; 0 is the vacuum, which is around every object and may be
 * within it. */
#define PHASETREE_MAX_PHASES 64
#define PHASETREE_VACUUM 0u
/* No phase known: see PhasetreeMedium. */
#define PHASETREE_UNKNOWN_PHASE 0xffffffffu

/* Handles: opaque and reference counted. */
typedef struct PhasetreeTreeHandle* PhasetreeTree;
typedef struct PhasetreeGeometryHandle* PhasetreeGeometry;

/* What a call returns. Why it failed is told by phasetreeGetErrorMessage. */
typedef enum PhasetreeError {
    PHASETREE_ERROR_NONE = 0,
    PHASETREE_ERROR_INVALID_HANDLE = 1,   /* NULL, freed, of another kind, or not ours at all */
    PHASETREE_ERROR_INVALID_ARGUMENT = 2, /* a value that the call's documentation excludes */
    PHASETREE_ERROR_INVALID_TREE = 3,     /* a scene file or text that is wrong: the message has file, line, column */
    PHASETREE_ERROR_INVALID_OPERATION = 4, /* not now: a hit that is no hit, an instance inside a query without one … */
    PHASETREE_ERROR_VERSION = 5,           /* see PHASETREE_API_VERSION */
    PHASETREE_ERROR_CANCELLED = 6,         /* by the options' cancelled or progress, or by Embree's memory monitor */
    PHASETREE_ERROR_OUT_OF_MEMORY = 7,
    PHASETREE_ERROR_EMBREE = 8, /* Embree refused; the message has its error's name */
    PHASETREE_ERROR_UNKNOWN = 9,
    PHASETREE_ERROR_CELLS_FILE = 10 /* a file of cells that cannot be read or written, is damaged, or does not fit */
} PhasetreeError;

/* Returns the version of the library that is linked, as PHASETREE_API_VERSION. */
PHASETREE_API unsigned int phasetreeGetApiVersion(void);

/* Returns what was wrong with the last call of *this thread* that failed, for a person, in UTF-8, without a newline at
 * its end; "" if none has. Good until the next call of this thread that fails, or the thread's end. */
PHASETREE_API const char* phasetreeGetErrorMessage(void);

#if defined(__cplusplus)
}
#endif

#endif
