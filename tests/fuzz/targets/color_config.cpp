// $OCIO's configurations: the display transform of one, applied to a few pixels.
#include <cmath>
#include <cstdlib>

#include "fuzz/input_file.hpp"
#include "output/display.hpp"
#include "output/error.hpp"

namespace phasetree::fuzz {

void run_color_config(Bytes input) {
    static InputFile file("config.ocio");
    ::setenv("OCIO", file.write(input).c_str(), 1);
    try {
        const tracer::DisplayTransform display(std::nullopt, std::nullopt, 1);
        std::array<glm::vec3, 3> pixels{glm::vec3(0.18f), glm::vec3(-1, 0, 1e6f), glm::vec3(NAN, INFINITY, 1)};
        display.apply(pixels);
    } catch (const tracer::DisplayError&) {
    }
    ::unsetenv("OCIO");
}

}  // namespace phasetree::fuzz
