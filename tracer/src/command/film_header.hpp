// The header of parts and checkpoints, which identifies their picture.
#pragma once

#include "command/render_options.hpp"
#include "film_file/header.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

// The header, except for what is known only after the object has been prepared. The options must have been applied to
// the scene.
FilmFileHeader header_of(const RenderOptions&, const Document&, const Scene&, const RenderJob&);
// Adds the rest. With little memory there are fewer cells, and positions on surfaces may be rounded differently.
void add_cells(FilmFileHeader&, const RenderOptions&, const CellStatistics&);

}  // namespace phasetree::tracer
