#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree {

/// GLSL functions that evaluate and trace an object, for both GLSL ES 3.00 (WebGL 2) and GLSL 3.30. The text has no
/// #version and no main(): put `#version 300 es` or `#version 330` before it, and your own shader after it.
struct GlslShader {
    std::string text;
    /// The constants of the functions, if there are too many for the text; otherwise empty. Upload them to the texture
    /// `phasetree_numbers`, with four 32-bit floats per texel and 1,024 texels per row. They are padded to whole rows.
    std::vector<float> numbers;
    /// The number of boxes in the grid, and of distinct programs in them; 0 without a grid.
    std::size_t boxes = 0, programs = 0;

    static constexpr std::size_t numbers_in_row = 4096;
};

struct GlslOptions {
    /// The name of each phase, for the comment at the top.
    std::span<const std::string> phase_names{};
    /// If there are more numbers than this, they go into a texture.
    std::size_t max_numbers_in_text = 1024;
    /// Programs with at most this many instructions are written as calls, longer ones as a table that a loop
    /// interprets, because the time to compile a shader grows much faster than its length.
    std::size_t max_calls = 128;
    /// The number of boxes along the longest side of the bounds; 0 for no grid. The program is pruned in each box, so
    /// rays through large objects evaluate only what is near them.
    int grid = 0;
    /// Maximum number of samples along a ray between two interfaces.
    int steps = 512;
    /// Polled; return true to cancel with BuildCancelled.
    std::function<bool()> cancelled{};
};

/// Generate GLSL from a program.
///
/// bounds      in which rays are traced; must include a margin of vacuum.
/// resolution  the maximum length of the bracket around a crossing (see Crossing). Shaders round more often than the
///             CPU, so it should be at least 10⁻⁵ of the bounds' diagonal.
///
/// prepare_to_trace() computes suitable bounds and a resolution. Throws ModelError if the program is longer than
/// max_glsl_instructions.
GlslShader make_glsl(const Program&, const Bounds&, float resolution, const GlslOptions& = {});

/// The maximum number of instructions. The numbers of longer programs would exceed what a web page or a driver accepts.
inline constexpr std::size_t max_glsl_instructions = 100'000;

}  // namespace phasetree
