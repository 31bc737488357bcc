// Reading of film files. Reading any file, however malformed, takes no more memory than a small multiple of its size.
#pragma once

#include <filesystem>

#include "film/film.hpp"
#include "film_file/error.hpp"
#include "film_file/header.hpp"

namespace phasetree::tracer {

/// A film file, of which only the header and the contents are kept in memory. The file is open only during reads, so
/// there may be thousands of these objects. All functions throw FilmFileError.
class FilmFile {
  public:
    /// Rejects files that are not film files, or that are truncated.
    explicit FilmFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    const FilmFileHeader& header() const { return header_; }
    /// Whether the film has all samples that it is to have.
    bool is_finished() const { return is_finished_; }
    /// The total number of samples of all pixels.
    std::uint64_t samples() const { return samples_; }

    /// The largest number of samples of any pixel. Reads the whole file.
    std::uint32_t most_samples_of_pixel() const;

    /// The i-th band. Rejects a damaged one.
    FilmTile band(int i) const;
    /// Adds the whole film to another film of the same picture.
    void add_to(Film& film) const;
    /// Rejects a file of another picture than `wanted`.
    void check_picture(const FilmFileHeader& wanted) const;

    /// Creates an error that names this file.
    FilmFileError error(const std::string& what) const;

  private:
    std::filesystem::path path_;
    FilmFileHeader header_;
    std::vector<std::uint64_t> bands_;  // offsets of their blocks
    std::uint64_t bytes_ = 0, samples_ = 0, least_of_pixel_ = 0;
    bool is_finished_ = false;
};

}  // namespace phasetree::tracer
