#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "phasetree/io/balls.hpp"

namespace phasetree::io {

/// The columns of balls, in the order of BallBuilder's numbers. The last two are optional.
inline constexpr std::array<std::string_view, 5> ball_columns{"x", "y", "z", "radius", "phase"};

/// Checks balls and adds them to a list, one at a time.
class BallBuilder {
  public:
    struct Mistake {
        std::size_t column;
        std::string_view message;
    };
    BallBuilder(bool has_radius, bool has_phase) : has_radius_(has_radius), has_phase_(has_phase) {}

    /// Adds a ball with these columns. Returns what is wrong with it, or nothing.
    std::optional<Mistake> add(const std::array<double, ball_columns.size()>& columns);
    BallList& balls() { return balls_; }

  private:
    bool has_radius_, has_phase_;
    BallList balls_;
};

/// Readers of file contents, as in mesh_file.hpp.
BallList read_ball_ply(const std::filesystem::path&, std::string_view content);
BallList read_ball_csv(const std::filesystem::path&, std::string_view content);

}  // namespace phasetree::io
