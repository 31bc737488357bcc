#include "scene/parts.hpp"

namespace phasetree::tracer {

RenderSettings read_settings(const Document& document, Value value, FilmSettings& film) {
    ObjectReader reader(document, value, "\"render\"");
    RenderSettings s;
    film.width = reader.optional("width", film.width, Range::between(1, 32768));
    film.height = reader.optional("height", film.height, Range::between(1, 32768));
    s.samples = reader.optional("samples", s.samples, Range::between(1, 1 << 24));
    s.seed = reader.optional("seed", s.seed);
    s.max_depth = reader.optional("max_depth", s.max_depth, Range::between(1, 1 << 20));
    s.exposure_ev = reader.optional("exposure", s.exposure_ev, Range::between(-50, 50));
    s.view = reader.maybe<std::string>("view");
    reader.finish();
    return s;
}

}  // namespace phasetree::tracer
