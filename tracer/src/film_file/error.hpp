#pragma once

#include <stdexcept>

namespace phasetree::tracer {

/// An unusable film file. The message is one line that names the file and the reason.
class FilmFileError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The file does not exist.
class FilmFileMissing : public FilmFileError {
  public:
    using FilmFileError::FilmFileError;
};

}  // namespace phasetree::tracer
