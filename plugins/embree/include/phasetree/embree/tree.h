/* Trees: reading, editing and asking them. The conventions are phasetree_embree.h's. */
#ifndef PHASETREE_EMBREE_TREE_H
#define PHASETREE_EMBREE_TREE_H

#include "phasetree/embree/common.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* Where PhasetreeFileReader.readImage puts an image: only within that call. */
typedef struct PhasetreeImageSink* PhasetreeImage;

/* Sets an image's size in pixels and makes room for its values.
 *
 * returns  the room, owned by the library, for width·height values: rows from the top, each value from 0 (low) to 1
 *          (high). NULL if a size is 0, above 32768, or memory is short. */
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

/* Reads a tree from a text in memory, else as phasetreeNewTreeFromFile does.
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

/* Adds a reference to a tree, or takes one away: the last one frees it. */
PHASETREE_API PhasetreeError phasetreeRetainTree(PhasetreeTree tree);
PHASETREE_API PhasetreeError phasetreeReleaseTree(PhasetreeTree tree);

/* How many phases the scene names, the vacuum included: the tree's phases are 0 … count − 1. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseCount(PhasetreeTree tree, unsigned int* count);

/* A phase's name, "vacuum" for 0. UTF-8; belongs to the tree and lives as long. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseName(PhasetreeTree tree, unsigned int phase, const char** name);

/* A phase's index by its name; INVALID_ARGUMENT if there is none of that name. */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseByName(PhasetreeTree tree, const char* name, unsigned int* phase);

/* Tells a phase's material: that member of the scene's "phases", from brace to brace as it is written there but without
 * comments, so that any reader of JSON takes it. NULL for the vacuum, where the scene has something else than an object
 * in its place, and for trees that were built in C++. The library itself does not look at materials: what is in them is
 * between the scene's author and the application (the path tracer's are in scenes/nodes.md). Belongs
 * to the tree and lives as long; an edit may change it, as anything in the text ("/phases/glass"). */
PHASETREE_API PhasetreeError phasetreeGetTreePhaseMaterial(PhasetreeTree tree, unsigned int phase, const char** json);

/* A box around everything that is not vacuum; infinite where the tree is. */
PHASETREE_API PhasetreeError phasetreeGetTreeBounds(PhasetreeTree tree, struct RTCBounds* bounds);

#if defined(__cplusplus)
}
#endif

#endif
