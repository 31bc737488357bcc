#include "film/film.hpp"

#include <algorithm>
#include <cstddef>

namespace phasetree::tracer {

void FilmTile::copy(const FilmTile& from, const PixelRange& part) {
    for (int y = part.y0; y < part.y1; ++y) {
        const auto row = from.pixels_.begin() + static_cast<std::ptrdiff_t>(from.area_.index(part.x0, y));
        std::copy_n(row, part.width(), pixels_.begin() + static_cast<std::ptrdiff_t>(area_.index(part.x0, y)));
    }
}

glm::dvec2 Film::sample_position(int x, int y, const glm::vec2& u) const {
    const glm::vec2 offset = settings_.filter.sample(u);
    return {x + 0.5 + static_cast<double>(offset.x), y + 0.5 + static_cast<double>(offset.y)};
}

FilmTile Film::tile(const PixelRange& part) const {
    FilmTile tile(part);
    tile.copy(pixels_, part);
    return tile;
}

Image Film::image() const {
    Image image = Planes::image(area().width(), area().height());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const FilmTile::Pixel& pixel = pixels_.pixels_[i];
        Planes::resolve(pixel.sums, std::max(pixel.samples, 1), image, i);
    }
    if (image.width != settings_.width || image.height != settings_.height)
        image.crop = Crop{area().x0, area().y0, settings_.width, settings_.height};
    return image;
}

}  // namespace phasetree::tracer
