#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "fuzz/target.hpp"

namespace phasetree::fuzz {

namespace {

constexpr Target list[] = {
    {"balls", Inputs::bytes, 4096, 5000, "", run_balls},
    {"calls", Inputs::bytes, 1024, 10000, "", run_calls},
    {"color_config", Inputs::lines, 16384, 500, "tracer/color", run_color_config},
    {"font", Inputs::bytes, 4096, 2000, "", run_font},
    {"gltf", Inputs::bytes, 8192, 5000, "", run_gltf},
    {"image", Inputs::bytes, 16384, 500, "", run_image},
    {"lines", Inputs::lines, 1024, 10000, "", run_lines},
    {"mesh", Inputs::bytes, 4096, 5000, "", run_mesh},
    {"obj", Inputs::lines, 4096, 10000, "", run_obj},
    {"part", Inputs::bytes, 8192, 3000, "", run_part},
    {"scene", Inputs::json, 8192, 10000, "scenes", run_scene},
    {"settings", Inputs::json, 8192, 500, "", run_settings},
    {"volume", Inputs::bytes, 32768, 1000, "", run_volume},
    {"weights", Inputs::json, 8192, 10000, "", run_weights},
};

}  // namespace

std::span<const Target> targets() {
    return list;
}

const Target& target(std::string_view name) {
    for (const Target& t : list)
        if (t.name == name) return t;
    throw std::invalid_argument("there is no fuzz target \"" + std::string(name) + "\"");
}

void broken(const char* promise) {
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}

}  // namespace phasetree::fuzz
