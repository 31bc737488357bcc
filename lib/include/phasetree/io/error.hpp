#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace phasetree {

/// A mistake in a scene file, as a message for people. what() reads
///
///     scene.json:12:9: unknown key "raduis" in the sphere (did you mean "radius"?)
///       "raduis": 2,
///       ^
///
/// or `file: message` without a position. Lines end at LF, CR LF or CR. Columns count code points from 1; a byte order
/// mark does not count.
class SceneError : public std::runtime_error {
  public:
    /// An error about a whole file, for example one that is missing or a directory.
    SceneError(std::string file, std::string message, std::optional<std::string> suggestion = {});

    /// An error at a byte offset of the file's text.
    SceneError(std::string file, std::string_view text, std::size_t offset, std::string message,
               std::optional<std::string> suggestion = {});

    /// An error at a line and a column, both from 1, in a text that is no longer available. what() does not show the
    /// line.
    SceneError(std::string file, std::size_t line, std::size_t column, std::string message);

    const std::string& file() const noexcept;
    /// From 1; 0 if the error has no position.
    std::size_t line() const noexcept;
    std::size_t column() const noexcept;
    /// The message without position and suggestion: one line of printable text.
    const std::string& message() const noexcept;
    /// The source line as shown by what(): printable, and cut to a window around the error if it is long.
    const std::string& quoted_line() const noexcept;
    const std::optional<std::string>& suggestion() const noexcept;

  private:
    struct Details;
    explicit SceneError(std::shared_ptr<const Details> details);
    std::shared_ptr<const Details> details_;  // shared, so that copying the exception cannot throw
};

}  // namespace phasetree
