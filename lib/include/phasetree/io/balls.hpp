#pragma once

#include <filesystem>

#include "phasetree/nodes/fields/ball_list.hpp"

namespace phasetree {

/// Read balls from a PLY or CSV file, chosen by the file name extension. Throws SceneError; the message never contains
/// text from the file.
BallList read_balls(const std::filesystem::path&);

}  // namespace phasetree
