// Identifies the scene of a picture.
#pragma once

#include <cstdint>

#include <string>
#include <utility>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// A hash of everything that a scene file says about the scene: its JSON values in order, and the content of every file
/// that one of its strings names. Different scenes have equal hashes with a probability of 2⁻⁶⁴. Ignores comments,
/// whitespace, number formatting, and "render", which says how the picture is made and not what it shows. Includes the
/// time at which the document is read.
std::uint64_t fingerprint(const Document& document);

/// The settings of "render" that affect the sample with a given number, as names and values. Excludes the number of
/// samples, the size of the picture, and how it is displayed.
std::vector<std::pair<std::string, std::string>> settings_of_samples(const RenderSettings& settings);

}  // namespace phasetree::tracer
