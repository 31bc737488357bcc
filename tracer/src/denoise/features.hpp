// Removes the features' own noise, which depth of field and rough glass cause. Each group of three channels, such as
// the albedo, is filtered by non-local means guided by the group itself (similarity.hpp). Source: Rousselle, Manzi &
// Zwicker, Robust Denoising using Feature and Color Information, Computer Graphics Forum 32(7), 2013, section 4.
#pragma once

#include <vector>

#include "denoise/regression.hpp"
#include "film/pixel_range.hpp"

namespace phasetree::tracer {

/// The features of an area, row by row.
std::vector<Features> without_noise(const Grid<Estimate<feature_count>>& features, const PixelRange& area);

}  // namespace phasetree::tracer
