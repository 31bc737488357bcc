// Which scene a picture is of.
#pragma once

#include <cstdint>

#include <string>
#include <utility>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

/// A number that differs, but for one chance in 2⁶⁴, if anything differs that a scene file says of the scene: the
/// values of its JSON, in their order, and the content of every file that one of its strings names. Comments, spaces,
/// and how numbers are written do not matter, and neither does "render", which says how the picture is made and not of
/// what. The time at which the document is read counts.
std::uint64_t fingerprint(const Document& document);

/// Those settings of "render" on which a sample of a given number depends, as names and values: all but how many
/// samples there are, how large the picture is and how it is shown.
std::vector<std::pair<std::string, std::string>> settings_of_samples(const RenderSettings& settings);

}  // namespace phasetree::tracer
