// What a film file says of the film in it.
//
// Checkpoints and parts are the same: a film, whole or in part, with the numbers of the samples that it is to have. The
// file is
//
//     magic           8 bytes, "phtfilm" and a line feed
//     format          u32, the version of this list: 2
//     header          a block (below), this header
//     bands           a block for each 16 rows of the film, from the top: FilmTile::write_row of each
//     contents        a block: the offset of each band's block (u64 each), how many samples all pixels have (u64), and
//                     whether the film is finished (u8)
//     offset          u64, where the contents begin
//     end             8 bytes, "phtdone" and a line feed
//
// A block is the number of its bytes (u64), these bytes, and their checksum (u64). Numbers have their lowest byte
// first. Where the end is missing the file is truncated; where a checksum differs it is damaged.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "film/film_settings.hpp"
#include "film/sample_range.hpp"

namespace phasetree::tracer {

inline constexpr std::string_view film_file_magic = "phtfilm\n", film_file_end = "phtdone\n";
inline constexpr std::uint32_t film_file_format = 2;
inline constexpr int band_rows = 16;

struct FilmFileHeader {
    /// What the pixels depend on beside the numbers of the samples, by the names that people know: the build of the
    /// program ("version"), the scene, options. Films are of the same picture if all these are equal, except "commit",
    /// which is for messages.
    std::vector<std::pair<std::string, std::string>> settings;
    /// The build of phasetree that rendered the samples, safe to print.
    std::string build() const;

    FilmSettings film;  ///< but for the filter, of which there is only one
    PlaneSubjects subjects;
    PixelRange area;
    /// The pixels of the picture, which lie in the area. Where blocks stop by their noise the film keeps them whole,
    /// for by all of its pixels it is decided whether a block goes on.
    PixelRange shown;
    SampleRange samples;     ///< that the film is to have
    int samples_in_all = 0;  ///< of the whole picture, of which these are a share

    // What image files say of the picture, and how it is shown.
    std::string scene;
    std::uint32_t seed = 0;
    float exposure_ev = 0;
    std::optional<std::string> view;

    int bands() const { return (area.height() + band_rows - 1) / band_rows; }
    PixelRange band(int i) const {
        const int first = area.y0 + i * band_rows;
        return {area.x0, first, area.x1, std::min(first + band_rows, area.y1)};
    }

    void write(ByteWriter& out) const;
    /// Throws BytesError, also for what cannot be: an area outside of the picture, planes that there are not.
    static FilmFileHeader read(ByteReader& in);
};

/// The first setting in which two films differ, as half a sentence about the second: "it has seed 3, not 4". Empty if
/// they are of the same picture. Whoever does not know the last settings yet may ask about the first.
std::string difference(const FilmFileHeader& wanted, const FilmFileHeader& found);

}  // namespace phasetree::tracer
