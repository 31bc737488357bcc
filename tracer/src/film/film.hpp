// The film: it says where on a pixel a sample falls, keeps what the planes accumulate, and gives images of that.
//
// A tile is what a rectangle of pixels has recorded. The film has one of its whole area; a thread fills a small one,
// which is empty at first, and the film adds up such tiles, in any order (contract.hpp says why that changes no bit).
//
// A pixel of the picture takes 52 bytes: three sums of 16 bytes, and the number of its samples. That is 431 MB for
// 3840×2160 pixels. A further plane adds what its sums take, 16 bytes for each value of which it keeps the mean, and
// nothing if it is not chosen; with 241 bytes a pixel such a film would reach 2 GB.
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

/// A rectangle of pixels with what has been added to each.
class FilmTile {
  public:
    FilmTile(const PixelRange& area, const Planes::Choice& planes, const PlaneSubjects& subjects)
        : area_(area),
          samples_(area.size()),
          sums_(planes, subjects, area.size()),
          faults_(static_cast<std::size_t>(area.height())) {}

    const PixelRange& area() const { return area_; }
    /// How many samples have been added to a pixel of the area.
    std::uint32_t samples(int x, int y) const { return samples_[area_.index(x, y)]; }
    /// What a plane keeps of a pixel; it must be one of those that are kept.
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
    /// Adds another tile of the same planes whose area lies within this one's. No sample may be in both.
    void join(const FilmTile& other);

    /// The names of the channels of its image, those of the picture first.
    std::vector<std::string> channels() const { return sums_.channels(); }
    /// An image of the whole area. Pixels without samples are black.
    Image image(const FilmSettings& settings) const;
    /// Writes the pixels of this tile into an image of a larger area that has the same channels, and what files say of
    /// the planes.
    void write_into(Image& image, const PixelRange& area) const;

    /// A row of the area as bytes; and back, into a tile that has no samples in that row. Both return how many samples
    /// the row has. Reading throws BytesError. A tile takes no more than some thirty times the bytes of its rows,
    /// whatever they say, because pixels without samples have theirs, too.
    std::uint64_t write_row(int y, ByteWriter& out) const;
    std::uint64_t read_row(int y, ByteReader& in);

  private:
    PixelRange area_;
    std::vector<std::uint32_t> samples_;  ///< row by row, as the sums are
    Planes::Sums sums_;
    std::vector<FilmFaults> faults_;  ///< of each row, so that a row is complete by itself
};

/// An image without samples of a part of a picture, with channels of these names, of which the first three are the
/// picture's.
Image black_image(const FilmSettings& settings, const PixelRange& area, const std::vector<std::string>& channels);

class Film {
  public:
    /// Keeps a part of the picture; the area is not empty and lies within it.
    Film(const FilmSettings& settings, const PixelRange& area, const PlaneSubjects& subjects = {})
        : settings_(settings), subjects_(subjects), pixels_(area, settings.planes, subjects) {}

    const PixelRange& area() const { return pixels_.area(); }
    const FilmSettings& settings() const { return settings_; }
    const PlaneSubjects& subjects() const { return subjects_; }
    /// While other threads add tiles, only pixels outside of those tiles may be read.
    const FilmTile& pixels() const { return pixels_; }

    /// Where a sample of pixel (x, y) falls, for u in [0, 1)²: in pixels from the top left corner of the picture,
    /// spread by the pixel filter around the pixel's centre (x + 1/2, y + 1/2).
    glm::dvec2 sample_position(int x, int y, const glm::vec2& u) const;

    /// A tile without samples of a part of the area.
    FilmTile tile(const PixelRange& part) const { return {part, settings_.planes, subjects_}; }
    /// Adds a tile. Any thread.
    void add(const FilmTile& tile) {
        const std::lock_guard lock(adding_);
        pixels_.join(tile);
    }
    /// A row as FilmTile::write_row has it, with all or nothing of any tile that is being added. Any thread.
    std::uint64_t write_row(int y, ByteWriter& out) const {
        const std::lock_guard lock(adding_);
        return pixels_.write_row(y, out);
    }

    /// What the planes have recorded; pixels without samples are black.
    Image image() const { return pixels_.image(settings_); }

  private:
    FilmSettings settings_;
    PlaneSubjects subjects_;
    FilmTile pixels_;
    mutable std::mutex adding_;
};

}  // namespace phasetree::tracer
