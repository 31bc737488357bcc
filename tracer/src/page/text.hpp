// The parts of a page that are the same for every object.
#pragma once

namespace phasetree::tracer::page {

extern const char* const head;     // up to the title
extern const char* const body;     // between the title and the data
extern const char* const script;   // after the data
extern const char* const shading;  // GLSL, after the functions of the object

}  // namespace phasetree::tracer::page
