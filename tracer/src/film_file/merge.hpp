// One film from its parts, in bounded memory: a few bands of sixteen rows, whatever the number and the size of the
// parts.
#pragma once

#include <functional>

#include "film_file/read.hpp"

namespace phasetree::tracer {

/// Films of one picture that have no sample in common.
class Parts {
  public:
    /// Opens all of them. Refuses parts of different pictures, and parts of which two have the same samples. Unless
    /// gaps are allowed, it refuses unfinished parts, and missing samples between the first and the last.
    /// Throws FilmFileError.
    Parts(const std::vector<std::filesystem::path>& paths, bool may_have_gaps);

    /// The header of all of them together, from the first sample to the last.
    const FilmFileHeader& header() const { return header_; }
    /// What is missing of the whole picture before the first part or after the last: "samples 48:64 are missing".
    /// Empty if nothing is.
    std::string missing() const;
    /// Whether there is no gap between the parts, and all are finished.
    bool are_joined() const { return are_joined_; }

    /// Joins the parts band by band, and calls `take` with each band from the top down. `stopped` is asked in between;
    /// if it says so no further band is made. Works on all threads. Throws FilmFileError.
    void join(const std::function<void(const FilmTile&)>& take, const std::function<bool()>& stopped) const;

  private:
    void check_ranges(bool may_have_gaps);

    std::vector<FilmFile> files_;  // by their first samples
    FilmFileHeader header_;
    bool are_joined_ = true;
};

}  // namespace phasetree::tracer
