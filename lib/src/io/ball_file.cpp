// Balls from files: the vertices of PLY, and the lines of CSV with a line of names first (RFC 4180, without quotes).
#include "io/ball_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/ply.hpp"
#include "io/read_file.hpp"
#include "io/utf8.hpp"
#include "io/words.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree {

namespace io {

namespace {

constexpr std::size_t radius = 3, phase = 4, required = 3;
constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30;
constexpr std::string_view too_many = "there are more balls than 16 million";

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(" \t\r"), text.size());
    text.remove_prefix(first);
    return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

// Takes the part of a line before the next comma, and what follows that stays.
std::string_view next_field(std::string_view& line) {
    const std::size_t end = std::min(line.find(','), line.size());
    const std::string_view field = without_blanks(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
    return field;
}

// For each column of ball_columns its number among those of the file.
using ColumnIndices = std::array<std::optional<std::size_t>, ball_columns.size()>;

// What columns are missing, or nothing.
std::string missing_columns(const ColumnIndices& indices, std::string_view of) {
    for (std::size_t i = 0; i < required; ++i)
        if (!indices[i]) return fmt::format("{} no column \"{}\"; they need x, y and z", of, ball_columns[i]);
    return {};
}

}  // namespace

std::string_view BallBuilder::add(const std::array<double, ball_columns.size()>& columns) {
    constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < required; ++i)
        if (!(std::abs(columns[i]) <= most)) return "a coordinate is no number, or too large";
    if (has_radius_ && !(columns[radius] > 0 && columns[radius] <= most)) return "a radius is not positive";
    if (has_phase_ && !(columns[phase] >= 0 && columns[phase] < 256 && columns[phase] == std::floor(columns[phase])))
        return "a phase is not a whole number from 0 to 255";
    if (balls_.centres.size() == BallList::most_balls) return too_many;
    balls_.centres.emplace_back(static_cast<float>(columns[0]), static_cast<float>(columns[1]),
                                static_cast<float>(columns[2]));
    if (has_radius_) balls_.radii.push_back(static_cast<float>(columns[radius]));
    if (has_phase_) balls_.phases.push_back(static_cast<std::uint8_t>(columns[phase]));
    return {};
}

BallList read_ball_ply(const std::filesystem::path& path, std::string_view content) {
    Ply ply(path, content);
    for (const Ply::Element& e : ply.elements()) {
        if (e.name != "vertex") {
            ply.for_each_row(e, [](const Ply::Row&) {});
            continue;
        }
        ColumnIndices indices;
        for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = e.find(ball_columns[i]);
        if (const std::string missing = missing_columns(indices, "its vertices have"); !missing.empty())
            throw SceneError(path.string(), missing);
        if (e.rows > BallList::most_balls) throw SceneError(path.string(), std::string(too_many));
        BallBuilder builder(indices[radius].has_value(), indices[phase].has_value());
        std::array<double, ball_columns.size()> columns{};
        ply.for_each_row(e, [&](const Ply::Row& row) {
            for (std::size_t i = 0; i < indices.size(); ++i)
                if (indices[i]) columns[i] = ply.number(e, row, *indices[i]);
            if (const std::string_view wrong = builder.add(columns); !wrong.empty()) ply.fail(e, wrong);
        });
        ply.finish();
        return std::move(builder.balls());
    }
    throw SceneError(path.string(), "has no vertices, which would be the balls");
}

BallList read_ball_csv(const std::filesystem::path& path, std::string_view content) {
    std::size_t number = 0, at = content.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
    const auto fail = [&](std::string_view what) {
        return SceneError(path.string(), fmt::format("{} (line {})", what, number));
    };
    // The next line that has anything; nothing at the end. Lines end with a line feed, a carriage return, or both.
    const auto next_line = [&]() -> std::optional<std::string_view> {
        while (at < content.size()) {
            const std::size_t end = std::min(content.find_first_of("\r\n", at), content.size());
            const std::string_view line = without_blanks(content.substr(at, end - at));
            at = end + (content.substr(end).starts_with("\r\n") ? 2 : 1);
            ++number;
            if (!line.empty() && line.front() != '#') return line;
        }
        return std::nullopt;
    };
    std::optional<std::string_view> line = next_line();
    if (!line) throw SceneError(path.string(), "has no lines");
    ColumnIndices indices;
    std::size_t columns = 0;
    for (; !line->empty(); ++columns) {
        const std::string_view name = next_field(*line);
        const auto known = std::ranges::find(ball_columns, name);
        if (known == ball_columns.end()) continue;
        std::optional<std::size_t>& index = indices[static_cast<std::size_t>(known - ball_columns.begin())];
        if (index) throw fail(fmt::format("there are two columns \"{}\"", *known));
        index = columns;
    }
    if (const std::string missing = missing_columns(indices, "the first line names"); !missing.empty())
        throw fail(missing);

    BallBuilder builder(indices[radius].has_value(), indices[phase].has_value());
    std::array<double, ball_columns.size()> values{};
    support::ReadingPlace place;
    while ((line = next_line())) {
        std::array<bool, ball_columns.size()> is_there{};
        for (std::size_t column = 0; !line->empty(); ++column) {
            const std::string_view field = next_field(*line);
            for (std::size_t i = 0; i < indices.size(); ++i) {
                if (indices[i] != column) continue;
                const auto value = number_of<double>(field);
                if (!value) throw fail(fmt::format("its {} is not a number", ball_columns[i]));
                values[i] = *value;
                is_there[i] = true;
            }
        }
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (indices[i] && !is_there[i]) throw fail(fmt::format("its {} is missing", ball_columns[i]));
        if (const std::string_view wrong = builder.add(values); !wrong.empty()) throw fail(wrong);
        place.reached(std::min(at, content.size()));
    }
    place.finished(content.size());
    return std::move(builder.balls());
}

}  // namespace io

BallList read_balls(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (ending == ".ply") return io::read_ball_ply(path, io::read_file(path, io::most_bytes));
    if (ending == ".csv") return io::read_ball_csv(path, io::read_file(path, io::most_bytes));
    throw SceneError(path.string(), "has no balls: its name must end with .ply or .csv");
}

}  // namespace phasetree
