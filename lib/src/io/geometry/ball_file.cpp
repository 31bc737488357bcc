// Reads balls from files: the vertices of PLY, or the rows of CSV with a header.
#include "io/geometry/ball_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/geometry/ply.hpp"
#include "io/read_file.hpp"
#include "phasetree/io/error.hpp"
#include "phasetree/io/number_table.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree {

namespace io {

namespace {

constexpr std::size_t radius = 3, phase = 4, required = 3;
constexpr std::uint64_t max_bytes = std::uint64_t{1} << 30;
constexpr std::string_view too_many = "there are more than 16 million balls";

// For each column of ball_columns, its index among the columns of the file.
using ColumnIndices = std::array<std::optional<std::size_t>, ball_columns.size()>;

// A message that lists the columns that the vertices lack, or "".
std::string missing_columns(const ColumnIndices& indices) {
    for (std::size_t i = 0; i < required; ++i)
        if (!indices[i])
            return fmt::format("its vertices have no column \"{}\"; they need x, y and z", ball_columns[i]);
    return {};
}

}  // namespace

std::optional<BallBuilder::Mistake> BallBuilder::add(const std::array<double, ball_columns.size()>& columns) {
    constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
    for (std::size_t i = 0; i < required; ++i)
        if (!(std::abs(columns[i]) <= most)) return Mistake{i, "a coordinate is not a number, or too large"};
    if (has_radius_ && !(columns[radius] > 0)) return Mistake{radius, "a radius is not positive"};
    if (has_radius_ && columns[radius] > most) return Mistake{radius, "a radius is too large"};
    if (has_phase_ && !(columns[phase] >= 0 && columns[phase] < 256 && columns[phase] == std::floor(columns[phase])))
        return Mistake{phase, "a phase is not a whole number from 0 to 255"};
    if (balls_.centres.size() == BallList::max_balls) return Mistake{0, too_many};
    balls_.centres.emplace_back(static_cast<float>(columns[0]), static_cast<float>(columns[1]),
                                static_cast<float>(columns[2]));
    if (has_radius_) balls_.radii.push_back(static_cast<float>(columns[radius]));
    if (has_phase_) balls_.phases.push_back(static_cast<std::uint8_t>(columns[phase]));
    return std::nullopt;
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
        if (const std::string missing = missing_columns(indices); !missing.empty())
            throw SceneError(path.string(), missing);
        if (e.rows > BallList::max_balls) throw SceneError(path.string(), std::string(too_many));
        BallBuilder builder(indices[radius].has_value(), indices[phase].has_value());
        std::array<double, ball_columns.size()> columns{};
        ply.for_each_row(e, [&](const Ply::Row& row) {
            for (std::size_t i = 0; i < indices.size(); ++i)
                if (indices[i]) columns[i] = ply.number(e, row, *indices[i]);
            if (const auto mistake = builder.add(columns)) ply.fail(e, mistake->message);
        });
        ply.finish();
        return std::move(builder.balls());
    }
    throw SceneError(path.string(), "has no element \"vertex\", which should contain the balls");
}

BallList read_ball_csv(const std::filesystem::path& path, std::string_view content) {
    std::vector<NumberTable::Column> wanted;
    for (std::size_t i = 0; i < ball_columns.size(); ++i) wanted.push_back({ball_columns[i], i < required});
    NumberTable table(path.string(), wanted, NumberTable::Header::required);
    std::optional<BallBuilder> builder;
    std::array<double, ball_columns.size()> values{};
    support::ReadingPlace place;
    for (std::size_t at = 0; at < content.size();) {
        const std::size_t end = std::min(content.find('\n', at), content.size());
        table.read_line(content.substr(at, end - at), [&] {
            if (!builder) builder.emplace(table.has(radius), table.has(phase));
            for (std::size_t i = 0; i < values.size(); ++i)
                if (table.has(i)) values[i] = table.number<double>(i);
            if (const auto mistake = builder->add(values))
                throw table.error(mistake->column, std::string(mistake->message));
        });
        at = std::min(end + 1, content.size());
        place.reached(at);
    }
    place.finished(content.size());
    if (!table.has_header()) throw SceneError(path.string(), "has no lines");
    return builder ? std::move(builder->balls()) : BallList();
}

}  // namespace io

BallList read_balls(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (ending == ".ply") return io::read_ball_ply(path, io::read_file(path, io::max_bytes));
    if (ending == ".csv") return io::read_ball_csv(path, io::read_file(path, io::max_bytes));
    throw SceneError(path.string(), "is not a file of balls: its name must end in .ply or .csv");
}

BallList FileFormat<BallList>::read(const std::filesystem::path& path) {
    return read_balls(path);
}

}  // namespace phasetree
