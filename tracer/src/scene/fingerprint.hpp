// Identifies the scene of a picture.
#pragma once

#include <cstdint>

#include <string>
#include <utility>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// A hash of everything in a scene file that affects what a picture shows: its JSON values in order, and the content of
/// every file that one of its strings names. Different scenes have equal hashes with a probability of 2⁻⁶⁴. Includes
/// the time at which the document is read. Ignores comments, whitespace, number formatting, "render" (how the picture
/// is made), "unit", "expect", and the densities of phases.
std::uint64_t fingerprint(const Document& document);

/// The settings of "render" that affect the sample with a given number, as names and values. Excludes the number of
/// samples, the size of the picture, and how it is displayed.
std::vector<std::pair<std::string, std::string>> settings_of_samples(const RenderSettings& settings);

}  // namespace phasetree::tracer
