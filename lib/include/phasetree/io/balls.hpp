#pragma once

#include <filesystem>

#include "phasetree/nodes/fields/ball_list.hpp"

namespace phasetree {

/// The balls of a PLY or CSV file, which its name's ending tells. Throws SceneError, which quotes nothing of the file.
BallList read_balls(const std::filesystem::path&);

}  // namespace phasetree
