// The built-in OpenColorIO configuration.
#pragma once

#include <string_view>

namespace phasetree::tracer {

/// The text of tracer/color/phasetree.ocio, used unless $OCIO names another configuration.
std::string_view default_color_config();

}  // namespace phasetree::tracer
