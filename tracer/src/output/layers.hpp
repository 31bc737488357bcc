// The planes of an image as files of their own: "film.{plane}.exr" is film.beauty.exr, film.depth.exr and so on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "film/image.hpp"

namespace phasetree::tracer {

/// What stands in a file's name for the name of a plane.
inline constexpr std::string_view plane_in_name = "{plane}";
/// What the layer of the picture is called.
inline constexpr const char* layer_of_picture = "beauty";

/// Channels that belong into one file.
struct Layer {
    std::string name;  ///< good as a part of a file's name
    bool has_picture = false;
    std::vector<const Channel*> channels{};  ///< of the image's further ones
    std::vector<std::pair<std::string, std::string>> attributes{};
};

/// All that an image has, as one layer.
Layer whole(const Image& image);

/// The picture, "beauty", with its alpha, A, and the image's further channels by what stands before the point in their
/// names: "depth.Z" is of "depth". The ranks of a Cryptomatte, CryptoPhase00, 01, …, are one layer with its manifest,
/// as its specification wants them. The channels keep their names, so that a compositor finds the same in many files as
/// in one.
std::vector<Layer> layers_of(const Image& image);

/// Whether a name asks for a file for each plane.
bool is_for_each_plane(const std::filesystem::path& path);
/// The file of a plane.
std::filesystem::path file_of_plane(const std::filesystem::path& path, const std::string& plane);

}  // namespace phasetree::tracer
