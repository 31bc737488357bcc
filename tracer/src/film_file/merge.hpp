// Merges parts into one film in bounded memory: a few bands of sixteen rows, whatever the number and size of the parts.
#pragma once

#include <functional>

#include "film_file/read.hpp"

namespace phasetree::tracer {

/// Films of one picture that have no samples in common.
class Parts {
  public:
    /// Opens all parts. Rejects parts of different pictures, and parts with samples in common. Unless gaps are allowed,
    /// also rejects unfinished parts and missing samples between the first and the last. Throws FilmFileError.
    Parts(const std::vector<std::filesystem::path>& paths, bool may_have_gaps);

    /// The header of the merged film, from the first sample to the last.
    const FilmFileHeader& header() const { return header_; }
    /// The samples of the whole picture that are missing before the first part or after the last, as in "samples 48:64
    /// are missing". Empty if there are none.
    std::string missing() const;
    /// Whether there are no gaps between the parts, and all are finished.
    bool are_joined() const { return are_joined_; }

    /// Joins the parts band by band and calls `take` with each band, from the top down. Polls `stopped` between bands,
    /// and returns early when it returns true. Uses all threads. Throws FilmFileError.
    void join(const std::function<void(const FilmTile&)>& take, const std::function<bool()>& stopped) const;

  private:
    void check_ranges(bool may_have_gaps);

    std::vector<FilmFile> files_;  // sorted by their first samples
    FilmFileHeader header_;
    bool are_joined_ = true;
};

}  // namespace phasetree::tracer
