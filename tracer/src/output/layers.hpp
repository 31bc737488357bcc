// Writes the planes of an image to separate files: "film.{plane}.exr" stands for film.beauty.exr, film.depth.exr and so
// on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "film/image.hpp"

namespace phasetree::tracer {

/// Placeholder for the plane's name in a file name.
inline constexpr std::string_view plane_in_name = "{plane}";
/// The name of the layer with the picture.
inline constexpr const char* layer_of_picture = "beauty";

/// Channels that belong in one file.
struct Layer {
    std::string name;  ///< usable in a file name
    bool has_picture = false;
    std::vector<const Channel*> channels{};  ///< the additional channels of the image
    std::vector<std::pair<std::string, std::string>> attributes{};
};

/// The whole image as one layer.
Layer whole(const Image& image);

/// Splits an image into layers: the picture, "beauty", with its alpha, A; and the image's additional channels, grouped
/// by the part of their names before the dot, as "depth" for "depth.Z". As its specification requires, the ranks of a
/// Cryptomatte (CryptoPhase00, 01, …) form one layer with its manifest. Channels keep their names, so a compositor
/// finds the same names in separate files as in a single one.
std::vector<Layer> layers_of(const Image& image);

/// The names of these layers.
std::vector<std::string> layer_names(const Image& image);

/// Whether a name asks for one file per plane.
bool is_for_each_plane(const std::filesystem::path& path);
/// The file name of a plane.
std::filesystem::path file_of_plane(const std::filesystem::path& path, const std::string& plane);

}  // namespace phasetree::tracer
