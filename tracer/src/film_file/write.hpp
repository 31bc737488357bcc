// Writing of film files.
#pragma once

#include <filesystem>

#include "film/film.hpp"
#include "film_file/header.hpp"

namespace phasetree::tracer {

/// Writes a film file from the top down. The file appears complete or not at all, and survives a power failure. All
/// functions throw OutputError, which names the file and leaves an existing file unchanged.
class FilmFileWriter {
  public:
    FilmFileWriter(const std::filesystem::path& path, const FilmFileHeader& header);
    ~FilmFileWriter();

    /// Appends the next band and the number of samples in it.
    void band(std::span<const std::byte> bytes, std::uint64_t samples);
    /// Completes the file after the last band.
    void finish(bool is_finished);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Writes a film to which other threads may be adding samples. It is marked as finished if it has all samples of its
/// header, or if `is_finished` is set, because pixels may have stopped by their noise. Throws OutputError, which names
/// the file and leaves an existing file unchanged.
void write_film(const std::filesystem::path& path, const FilmFileHeader& header, const Film& film,
                bool is_finished = false);

/// Whether a file name denotes a film file, "NAME.part", rather than an image.
bool is_film_file(const std::filesystem::path& path);

}  // namespace phasetree::tracer
