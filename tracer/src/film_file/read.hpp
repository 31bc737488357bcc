// Films from files. Whatever a file is, reading it takes no more memory than a small multiple of its own size.
#pragma once

#include <filesystem>

#include "film/film.hpp"
#include "film_file/error.hpp"
#include "film_file/header.hpp"

namespace phasetree::tracer {

/// A film file, of which no more than the header and the contents are in memory; the file is open only while something
/// is read, so there may be thousands. All functions throw FilmFileError.
class FilmFile {
  public:
    /// Refuses what is no film file, and one that is truncated.
    explicit FilmFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    const FilmFileHeader& header() const { return header_; }
    /// Whether the film has all samples that it is to have.
    bool is_finished() const { return is_finished_; }
    /// How many samples all pixels have together.
    std::uint64_t samples() const { return samples_; }

    /// How many samples the pixel has that has most; reads all of it.
    std::uint32_t most_samples_of_pixel() const;

    /// The i-th band. Refuses one that is damaged.
    FilmTile band(int i) const;
    /// Adds all of it to a film of the same picture.
    void add_to(Film& film) const;
    /// Refuses a file that is of another picture than `wanted`.
    void check_picture(const FilmFileHeader& wanted) const;

    /// An error that names this file.
    FilmFileError error(const std::string& what) const;

  private:
    std::filesystem::path path_;
    FilmFileHeader header_;
    std::vector<std::uint64_t> bands_;  // the offsets of their blocks
    std::uint64_t bytes_ = 0, samples_ = 0, least_of_pixel_ = 0;
    bool is_finished_ = false;
};

}  // namespace phasetree::tracer
