// Films into files.
#pragma once

#include <filesystem>

#include "film/film.hpp"
#include "film_file/header.hpp"

namespace phasetree::tracer {

/// A film file that is written from the top down. It appears complete or not at all, and outlives a loss of power. All
/// functions throw OutputError, which names the file; then an existing file is untouched.
class FilmFileWriter {
  public:
    FilmFileWriter(const std::filesystem::path& path, const FilmFileHeader& header);
    ~FilmFileWriter();

    /// The bytes of the next band, and how many samples are in it.
    void band(std::span<const std::byte> bytes, std::uint64_t samples);
    /// After the last band.
    void finish(bool is_finished);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Writes a film, to which others may add meanwhile. It is finished if it has all samples of its header, or if that is
/// said: pixels may have stopped by their noise. Throws OutputError, which names the file; then an existing file is
/// untouched.
void write_film(const std::filesystem::path& path, const FilmFileHeader& header, const Film& film,
                bool is_finished = false);

/// Whether a file's name is that of a film file, and not of an image: "NAME.part".
bool is_film_file(const std::filesystem::path& path);

}  // namespace phasetree::tracer
