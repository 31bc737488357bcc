#include "phasetree/io/read_kind.hpp"
#include "scene/image_parameters.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

RenderSettings read_settings(const Document& document, Value value, FilmSettings& film) {
    const auto image = read_kind<ImageParameters>(document, value, "\"render\"", [](const ImageParameters& p) {
        if (p.shutter.y < p.shutter.x) throw ParameterError("shutter", "the shutter must not close before it opens");
        return p;
    });
    film.width = image.width;
    film.height = image.height;
    return image;
}

}  // namespace phasetree::tracer
