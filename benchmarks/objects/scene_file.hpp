#pragma once

#include <string>

#include "scene/scene.hpp"

namespace phasetree::bench {

// "hourglass" or "benchmark/hourglass_monophase": a scene of the project's scenes/.
tracer::Scene scene_file(const std::string& name);

}  // namespace phasetree::bench
