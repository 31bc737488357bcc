// The header of a film file, which describes its film.
//
// Checkpoints and parts have the same format: a complete film, or a share of one, with the numbers of the samples that
// it is to have. The layout of the file is
//
//     magic           8 bytes, "phtfilm" and a line feed
//     format          u32, the version of this layout: 2
//     header          a block (see below), this header
//     bands           a block per 16 rows of the film, from the top: FilmTile::write_row of each
//     contents        a block: the offset of each band's block (u64 each), the number of samples of all pixels (u64),
//                     and whether the film is finished (u8)
//     offset          u64, the position of the contents
//     end             8 bytes, "phtdone" and a line feed
//
// A block consists of its size in bytes (u64), the bytes, and their checksum (u64). Numbers are little-endian. A file
// without the end mark is truncated; one with a wrong checksum is damaged.
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
    /// Everything that the pixels depend on except the sample numbers, under user-visible names: the build of the
    /// program ("version"), the scene, and options. Two films show the same picture if all settings are equal, except
    /// "commit", which is only used in messages.
    std::vector<std::pair<std::string, std::string>> settings;
    /// The build of phasetree that rendered the samples, safe to print.
    std::string build() const;

    FilmSettings film;  ///< except for the filter, of which there is only one kind
    SceneNames scene_names;
    PixelRange area;
    /// The pixels of the picture, which lie in the film's area. If blocks stop by their noise, the film contains whole
    /// blocks, because all of a block's pixels decide whether it continues.
    PixelRange shown;
    SampleRange samples;     ///< the samples that the film is to have
    int samples_in_all = 0;  ///< samples of the whole picture, of which these are a share

    // Metadata of image files, and how to display them.
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
    /// Throws BytesError, also for inconsistent values: an area outside the picture, or unknown planes.
    static FilmFileHeader read(ByteReader& in);
};

/// The first setting in which two films differ, as a clause about the second: "it has seed 3, not 4". Empty if they
/// show the same picture. A caller that does not know the last settings yet may compare the first ones.
std::string difference(const FilmFileHeader& wanted, const FilmFileHeader& found);

}  // namespace phasetree::tracer
