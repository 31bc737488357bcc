#pragma once

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
    /// The numbers of the instances of nodes, if they are too many to stand in the text. They are then the red channel
    /// of the texture `phasetree_numbers`, 1,024 to a row, in 32-bit floats, and text reads them with texelFetch.
    std::vector<float> numbers;

    static constexpr int numbers_in_row = 1024;
};

struct GlslOptions {
    /// The name of each phase, for the comment at the top.
    std::span<const std::string> phase_names{};
    /// More numbers than this become a texture.
    std::size_t most_numbers_in_text = 2048;
    /// The most steps along a ray between two interfaces.
    int steps = 512;
};

/// The bounds are those in which rays are traced, with a margin of vacuum; the resolution is the length of the longest
/// bracket (prepare_to_trace() knows both). Throws ModelError if the program is too long for a shader.
GlslShader make_glsl(const Program&, const Bounds&, float resolution, const GlslOptions& = {});

/// Programs of more instructions are refused, because compilers of shaders do not cope with them.
inline constexpr std::size_t longest_glsl_program = 20'000;

}  // namespace phasetree
