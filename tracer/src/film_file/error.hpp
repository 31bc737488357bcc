#pragma once

#include <stdexcept>

namespace phasetree::tracer {

/// A film file that cannot be used. The message names the file and says why, in one line.
class FilmFileError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// There is no such file.
class FilmFileMissing : public FilmFileError {
  public:
    using FilmFileError::FilmFileError;
};

}  // namespace phasetree::tracer
