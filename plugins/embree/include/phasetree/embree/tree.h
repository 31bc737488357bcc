/* Trees: loading, editing and inspecting them. See phasetree_embree.h for the conventions. */
#ifndef PHASETREE_EMBREE_TREE_H
#define PHASETREE_EMBREE_TREE_H

#include "phasetree/embree/common.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* The destination of PhasetreeFileReader.readImage. Valid only during that call. */
typedef struct PhasetreeImageSink* PhasetreeImage;

/* Sets the size of an image in pixels and allocates its values.
 *
 * returns  an array of width·height values, owned by the library, to be filled row by row from the top with values
 *          from 0 (low) to 1 (high). NULL if a size is 0 or above 32768, or if memory is exhausted. */
PHASETREE_API float* phasetreeNewImageValues(PhasetreeImage image, unsigned int width, unsigned int height);

/* Reads the height maps of a scene, because the library has no image readers of its own. It reads no other images,
 * OpenVDB files or fonts: a tree with a `labels`, `volume` or `text` node is rejected.
 *
 * readImage is called on the calling thread, during the call that received the reader. The path is UTF-8 and relative
 * to the working directory, not to the scene. On success, readImage allocates the values with phasetreeNewImageValues,
 * fills them and returns NULL. On failure it returns a message, which must stay valid until the outer call returns.
 * userPtr is passed through. */
typedef struct PhasetreeFileReader {
    const char* (*readImage)(void* userPtr, const char* path, PhasetreeImage image);
    void* userPtr;
} PhasetreeFileReader;

/* Loads a tree from a JSON scene file. Members other than "phases", "shapes" and "tree" are ignored.
 *
 * path    UTF-8, null-terminated.
 * reader  reads height maps; with NULL, a scene with a height map is an error. The struct is copied. Whatever its
 *         userPtr points to must outlive the tree and all trees edited from it, because edits read the files again.
 * tree    receives the new handle.
 *
 * File names in the scene are relative to the scene's folder. All files are read during the call. */
PHASETREE_API PhasetreeError phasetreeNewTreeFromFile(unsigned int apiVersion, const char* path,
                                                      const PhasetreeFileReader* reader, PhasetreeTree* tree);

/* Loads a tree from JSON text in memory. Otherwise like phasetreeNewTreeFromFile.
 *
 * text    UTF-8, `length` bytes, not necessarily null-terminated. Copied.
 * name    the name to use in error messages; its folder is where files are looked up. NULL for "<text>" and the working
 *         directory. */
PHASETREE_API PhasetreeError phasetreeNewTreeFromText(unsigned int apiVersion, const char* text, size_t length,
                                                      const char* name, const PhasetreeFileReader* reader,
                                                      PhasetreeTree* tree);

/* Returns a new tree in which one value of the scene text is replaced. The original tree is unchanged.
 *
 * path    a JSON Pointer (RFC 6901) to a value in the scene text, such as "/shapes/bulb/sphere/radius" or
 *         "/tree/under/0". A change to a named shape applies wherever the shape is used.
 * value   the new value as null-terminated JSON: "0.5", "[1, 0, 0]", "\"glass\"", or a whole subtree.
 *
 * The edited text and all files that it names are read again. Errors refer to lines and columns of the edited text. */
PHASETREE_API PhasetreeError phasetreeNewEditedTree(PhasetreeTree tree, const char* path, const char* value,
                                                    PhasetreeTree* edited);

/* Adds a reference to a tree, or drops one. Dropping the last reference frees the tree. */
PHASETREE_API PhasetreeError phasetreeRetainTree(PhasetreeTree tree);
PHASETREE_API PhasetreeError phasetreeReleaseTree(PhasetreeTree tree);

/* Returns the number of phases, including the vacuum. The tree's phases are 0 … count − 1. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseCount(PhasetreeTree tree, unsigned int* count);

/* Returns the name of a phase in UTF-8; phase 0 is "vacuum". The string is valid as long as the tree. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseName(PhasetreeTree tree, unsigned int phase, const char** name);

/* Finds a phase by its name; PHASETREE_ERROR_INVALID_ARGUMENT if no phase has that name. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseByName(PhasetreeTree tree, const char* name, unsigned int* phase);

/* Returns the material of a phase as JSON: the phase's member of the scene's "phases" as written, but without comments.
 * *json is NULL, without an error, for the vacuum, for a phase whose member is not an object, and for trees built in
 * C++.
 *
 * The library does not interpret materials: that is up to the application. The scene file reference
 * (scenes/reference) describes those of the path tracer. The string is valid as long as the tree. An edited tree
 * (phasetreeNewEditedTree) may have a different material for this phase, because materials are part of the text that
 * can be edited ("/phases/glass"). */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseMaterial(PhasetreeTree tree, unsigned int phase, const char** json);

/* Returns a box around everything that is not vacuum. It is infinite in the directions in which the tree is unbounded.
 */
PHASETREE_API PhasetreeError phasetreeGetTreeBounds(PhasetreeTree tree, struct RTCBounds* bounds);

#if defined(__cplusplus)
}
#endif

#endif
