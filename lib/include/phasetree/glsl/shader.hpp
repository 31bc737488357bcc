#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree {

/// Functions in GLSL that evaluate and trace an object, for GLSL ES 3.00 (WebGL 2) and 3.30 alike. The text has no
/// #version and no main(): put `#version 300 es` or `#version 330` before it and a shader of your own behind it.
struct GlslShader {
    std::string text;
    /// The numbers that the functions read, if they are too many to stand in the text. They are then the texture
    /// `phasetree_numbers`, of four 32-bit floats to a texel and 1,024 texels to a row, and fill its rows.
    std::vector<float> numbers;
    /// The boxes of the grid, and how many different programs they have; 0 without a grid.
    std::size_t boxes = 0, programs = 0;

    static constexpr std::size_t numbers_in_row = 4096;
};

struct GlslOptions {
    /// The name of each phase, for the comment at the top.
    std::span<const std::string> phase_names{};
    /// More numbers than this become a texture.
    std::size_t most_numbers_in_text = 1024;
    /// Programs of at most this many instructions are written as calls, longer ones as a table that a loop runs: the
    /// time of shader compilers grows much faster than the length of the text.
    std::size_t most_calls = 128;
    /// The boxes along the longest side of the bounds in which the program is pruned, so that rays through large
    /// objects evaluate only what is near them; 0 for none.
    int grid = 0;
    /// The most samples along a ray between two interfaces.
    int steps = 512;
    /// Polled; return true to stop with BuildCancelled.
    std::function<bool()> cancelled{};
};

/// The bounds are those in which rays are traced, with a margin of vacuum; the resolution is the length of the longest
/// bracket (prepare_to_trace() knows both; numbers of shaders are rounded more often, so it should be 10⁻⁵ of the
/// bounds' diagonal at least). Throws ModelError if the program is too long for a shader.
GlslShader make_glsl(const Program&, const Bounds&, float resolution, const GlslOptions& = {});

/// Longer programs are rejected, because their numbers would exceed what a page or a driver accepts.
inline constexpr std::size_t longest_glsl_program = 100'000;

}  // namespace phasetree
