#pragma once

#include <stdexcept>
#include <string>
#include <system_error>

namespace phasetree::support {

/// An error that the system reports for a file. The message does not name the file; the caller knows its name.
class FileError : public std::runtime_error {
  public:
    explicit FileError(int code) : FileError(code, std::generic_category().message(code)) {}
    FileError(int code, const std::string& what) : std::runtime_error(what), code_(code) {}
    bool is_missing() const {
        return code_ == static_cast<int>(std::errc::no_such_file_or_directory) ||
               code_ == static_cast<int>(std::errc::not_a_directory);
    }

  private:
    int code_;
};

}  // namespace phasetree::support
