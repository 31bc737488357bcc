// The parts of a page that depend on no object.
#pragma once

namespace phasetree::tracer::page {

extern const char* const head;     // up to the title
extern const char* const body;     // from behind the title to the data
extern const char* const script;   // behind the data
extern const char* const shading;  // GLSL, behind the functions of the object

}  // namespace phasetree::tracer::page
