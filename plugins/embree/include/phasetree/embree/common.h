/* Common definitions: Embree's header, the version, phases, handles, errors. See phasetree_embree.h for the
 * conventions. */
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

/* The version of this interface: 100 · PHASETREE_API_NUMBER + Embree's major version. As long as PHASETREE_API_NUMBER
 * stays the same, structures and functions do not change. Pass PHASETREE_API_VERSION wherever a function has a
 * parameter apiVersion. A library that does not support that version, or was built for the other Embree, returns
 * PHASETREE_ERROR_VERSION. */
#define PHASETREE_API_NUMBER 2
#define PHASETREE_API_VERSION (100 * PHASETREE_API_NUMBER + RTC_VERSION_MAJOR)

/* Phase indices are 0 … PHASETREE_MAX_PHASES − 1. Phase 0 is the vacuum, which surrounds every object and may also be
 * inside it. */
#define PHASETREE_MAX_PHASES 64
#define PHASETREE_VACUUM 0u
/* The phase is not known; see PhasetreeRay.carried. */
#define PHASETREE_UNKNOWN_PHASE 0xffffffffu

/* Opaque, reference-counted handles. */
typedef struct PhasetreeTreeHandle* PhasetreeTree;
typedef struct PhasetreeGeometryHandle* PhasetreeGeometry;

/* Error codes. Call phasetreeGetErrorMessage to find out why a call failed. */
typedef enum PhasetreeError {
    PHASETREE_ERROR_NONE = 0,
    PHASETREE_ERROR_INVALID_HANDLE = 1,   /* NULL, freed, of the other kind, or not a handle */
    PHASETREE_ERROR_INVALID_ARGUMENT = 2, /* a value that the function's documentation excludes */
    PHASETREE_ERROR_INVALID_TREE = 3, /* an invalid scene (the message has file, line and column), or a tree that the
                                         call cannot use, such as an unbounded one */
    PHASETREE_ERROR_INVALID_OPERATION = 4, /* not possible in this state, such as decoding a miss */
    PHASETREE_ERROR_VERSION = 5,           /* see PHASETREE_API_VERSION */
    PHASETREE_ERROR_CANCELLED = 6,         /* by a callback of the options, or by Embree's memory monitor */
    PHASETREE_ERROR_OUT_OF_MEMORY = 7,
    PHASETREE_ERROR_EMBREE = 8, /* Embree reported an error; the message names it */
    PHASETREE_ERROR_UNKNOWN = 9,
    PHASETREE_ERROR_CELLS_FILE = 10 /* a cell file cannot be read or written, is damaged, or does not match */
} PhasetreeError;

/* Returns the version of the linked library, in the form of PHASETREE_API_VERSION. */
PHASETREE_API unsigned int phasetreeGetApiVersion(void);

/* Returns a message for the last call that failed *on the calling thread*, or "" if none has failed. The message is
 * UTF-8 text without a trailing newline. It is valid until the next failing call on this thread, or until the thread
 * ends. */
PHASETREE_API const char* phasetreeGetErrorMessage(void);

#if defined(__cplusplus)
}
#endif

#endif
