// The film: positions samples within pixels, accumulates planes, and resolves them to images.
//
// A tile contains the sums of a rectangle of pixels. The film has one tile for its whole area. A thread fills a small
// one, which is empty at first, and the film joins such tiles in any order (contract.hpp explains why the result is the
// same bit for bit).
//
//     per pixel                                  bytes
//     default planes: three sums of 16 bytes,
//     and the number of samples                     52    (431 MB for 3840×2160 pixels)
//     each further mean of a chosen plane           16
//     at most, in a film of 2 GB of that size      241
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <mutex>
#include <vector>

#include "film/film_settings.hpp"
#include "film/image.hpp"
#include "film/pixel_range.hpp"
#include "film/planes.hpp"

namespace phasetree::tracer {

/// A rectangle of pixels and the sums of each.
class FilmTile {
  public:
    FilmTile(const PixelRange& area, const Planes::Choice& planes, const SceneNames& scene_names)
        : area_(area),
          samples_(area.size()),
          sums_(planes, scene_names, area.size()),
          faults_(static_cast<std::size_t>(area.height())) {}

    const PixelRange& area() const { return area_; }
    /// The number of samples that have been added to a pixel of the area.
    std::uint32_t samples(int x, int y) const { return samples_[area_.index(x, y)]; }
    /// The sums of a plane at a pixel. The plane must be a chosen one.
    template <class Plane>
    std::span<const typename Plane::Sum> sums_of(int x, int y) const {
        return sums_.of<Plane>(area_.index(x, y));
    }
    FilmFaults faults() const {
        FilmFaults sum;
        for (const FilmFaults& row : faults_) sum += row;
        return sum;
    }

    /// Adds a sample to a pixel of the area.
    void add(int x, int y, const FilmSample& sample) {
        const std::size_t pixel = area_.index(x, y);
        sums_.add(pixel, sample, faults_[static_cast<std::size_t>(y - area_.y0)]);
        ++samples_[pixel];
    }
    /// Joins another tile with the same planes, whose area is inside this one's. No sample may be in both.
    void join(const FilmTile& other);

    /// The names of the channels of its image, those of the picture first.
    std::vector<std::string> channels() const { return sums_.channels(); }
    /// An image of the whole area. Pixels without samples are black.
    Image image(const FilmSettings& settings) const;
    /// Writes the pixels of this tile, and the planes' attributes, to an image of a larger area that has the same
    /// channels.
    void write_into(Image& image, const PixelRange& area) const;

    /// Writes a row of the area as bytes, or reads one into a tile that has no samples in that row. Both return the
    /// number of samples in the row. Reading throws BytesError. Even for forged input, the memory of a tile is at most
    /// about thirty times the size of its rows in the file, because a row has some bytes for each pixel, even for one
    /// without samples.
    std::uint64_t write_row(int y, ByteWriter& out) const;
    std::uint64_t read_row(int y, ByteReader& in);

  private:
    PixelRange area_;
    std::vector<std::uint32_t> samples_;  ///< row by row, like the sums
    Planes::Sums sums_;
    std::vector<FilmFaults> faults_;  ///< of each row, so that a row is self-contained
};

/// A black image of a part of a picture, as if it had no samples. The first three channel names are the picture's.
Image black_image(const FilmSettings& settings, const PixelRange& area, const std::vector<std::string>& channels);

class Film {
  public:
    /// Makes a film for a part of the picture. The area must not be empty and must be inside the picture.
    Film(const FilmSettings& settings, const PixelRange& area, const SceneNames& scene_names = {})
        : settings_(settings), scene_names_(scene_names), pixels_(area, settings.planes, scene_names) {}

    const PixelRange& area() const { return pixels_.area(); }
    const FilmSettings& settings() const { return settings_; }
    const SceneNames& scene_names() const { return scene_names_; }
    /// While other threads add tiles, only pixels outside of those tiles may be read.
    const FilmTile& pixels() const { return pixels_; }

    /// The position of a sample of pixel (x, y), for u in [0, 1)²: in pixels from the top left corner of the picture,
    /// distributed by the pixel filter around the pixel's centre (x + 1/2, y + 1/2).
    glm::dvec2 sample_position(int x, int y, const glm::vec2& u) const;

    /// An empty tile for a part of the area.
    FilmTile tile(const PixelRange& part) const { return {part, settings_.planes, scene_names_}; }
    /// Adds a tile. Thread-safe.
    void add(const FilmTile& tile) {
        const std::lock_guard lock(adding_);
        pixels_.join(tile);
    }
    /// Writes a row, see FilmTile::write_row. A tile that is being added is included completely or not at all.
    /// Thread-safe.
    std::uint64_t write_row(int y, ByteWriter& out) const {
        const std::lock_guard lock(adding_);
        return pixels_.write_row(y, out);
    }

    /// The image of the planes; pixels without samples are black.
    Image image() const { return pixels_.image(settings_); }

  private:
    FilmSettings settings_;
    SceneNames scene_names_;
    FilmTile pixels_;
    mutable std::mutex adding_;
};

}  // namespace phasetree::tracer
