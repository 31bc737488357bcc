// What parts and checkpoints say of the picture that they are of.
#pragma once

#include "command/render_options.hpp"
#include "film_file/header.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

// All but what is known only when the object has been prepared. The scene has what the options say of it.
FilmFileHeader header_of(const RenderOptions&, const Document&, const Scene&, const RenderJob&);
// The rest. Where memory is short there are fewer cells, and places on surfaces may be rounded otherwise.
void add_cells(FilmFileHeader&, const RenderOptions&, const CellStatistics&);

}  // namespace phasetree::tracer
