// The film: it says where on a pixel a sample falls, keeps what the planes accumulate, and gives images of that.
//
// Threads work on tiles. A tile is a copy of a rectangle of the film's pixels with all that was added to them before;
// samples are added to the tile, and merging puts its pixels back in place of the film's. As the tiles of one pass over
// the picture do not overlap, each pixel's samples are added in one order, and neither the order in which tiles are
// merged nor the number of threads changes a bit. Rectangles that were added up instead would round differently.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "film/image.hpp"
#include "film/pixel_filter.hpp"
#include "film/pixel_range.hpp"
#include "film/planes.hpp"

namespace phasetree::tracer {

/// The whole picture, whatever part of it is rendered.
struct FilmSettings {
    int width = 1024;  ///< in pixels, at least 1
    int height = 768;  ///< in pixels, at least 1
    PixelFilter filter{};

    glm::ivec2 resolution() const { return {width, height}; }
    PixelRange whole() const { return {0, 0, width, height}; }
};

/// A rectangle of pixels with what has been added to each.
class FilmTile {
  public:
    explicit FilmTile(const PixelRange& area) : area_(area), pixels_(area.size()) {}

    const PixelRange& area() const { return area_; }
    /// Adds a sample to a pixel of the area.
    void add(int x, int y, const FilmSample& sample) {
        Pixel& pixel = pixels_[area_.index(x, y)];
        Planes::add(pixel.sums, sample);
        ++pixel.samples;
    }

  private:
    friend class Film;
    struct Pixel {
        Planes::Sums sums{};
        int samples = 0;
    };
    void copy(const FilmTile& from, const PixelRange& part);

    PixelRange area_;
    std::vector<Pixel> pixels_;  ///< row by row
};

class Film {
  public:
    /// Keeps a part of the picture; the area is not empty and lies within it.
    Film(const FilmSettings& settings, const PixelRange& area) : settings_(settings), pixels_(area) {}

    const PixelRange& area() const { return pixels_.area(); }

    /// Where a sample of pixel (x, y) falls, for u in [0, 1)²: in pixels from the top left corner of the picture,
    /// spread by the pixel filter around the pixel's centre (x + 1/2, y + 1/2).
    glm::dvec2 sample_position(int x, int y, const glm::vec2& u) const;

    /// A tile to which samples can be added, of a part of the area.
    FilmTile tile(const PixelRange& part) const;
    /// Puts back a tile. Several threads may do so at once with tiles that do not overlap.
    void merge(const FilmTile& tile) { pixels_.copy(tile, tile.area()); }

    /// What the planes have recorded; pixels without samples are black.
    Image image() const;

  private:
    FilmSettings settings_;
    FilmTile pixels_;
};

}  // namespace phasetree::tracer
