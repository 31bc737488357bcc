#include "command/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <istream>
#include <utility>
#include <vector>

namespace phasetree::tracer {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

std::size_t skip_blanks(std::string_view line, std::size_t at) {
    while (at < line.size() && is_blank(line[at])) ++at;
    return at;
}

InputError error(std::size_t line, std::size_t at, const std::string& message) {
    return InputError(fmt::format("<stdin>:{}:{}: {}", line, at + 1, message));
}

// Reads a finite number and moves `at` behind it.
bool read_number(std::string_view line, std::size_t& at, float& value) {
    const auto [rest, problem] = std::from_chars(line.data() + at, line.data() + line.size(), value);
    if (problem != std::errc() || !std::isfinite(value)) return false;
    at = static_cast<std::size_t>(rest - line.data());
    return true;
}

// What is no number, and does not look as if it were meant to be one.
bool is_header(std::string_view line, std::size_t at) {
    std::string word;
    for (std::size_t i = at; i < line.size() && std::isalpha(static_cast<unsigned char>(line[i])); ++i)
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(line[i])));
    const bool is_word = !word.empty() || line[at] == '"' || line[at] == '_';
    return is_word && word != "nan" && word != "inf" && word != "infinity";
}

struct Cell {
    std::size_t at;
    std::string text;
};

// Blanks about a cell do not count, quotes about it neither.
std::vector<Cell> cells_of(std::string_view line) {
    std::vector<Cell> cells;
    for (std::size_t at = 0; at <= line.size(); ++at) {
        Cell cell{skip_blanks(line, at), {}};
        at = cell.at;
        if (at < line.size() && line[at] == '"') {
            for (++at; at < line.size() && (line[at] != '"' || (at + 1 < line.size() && line[at + 1] == '"')); ++at) {
                if (line[at] == '"') ++at;
                cell.text += line[at];
            }
            at = std::min(line.find(',', at), line.size());
        } else {
            const std::size_t end = std::min(line.find(',', at), line.size());
            cell.text = line.substr(at, end - at);
            while (!cell.text.empty() && is_blank(cell.text.back())) cell.text.pop_back();
            at = end;
        }
        cells.push_back(std::move(cell));
    }
    return cells;
}

// Where in each line the columns are.
std::vector<std::size_t> places(std::string_view header, std::size_t number,
                                std::span<const std::string_view> columns) {
    const std::vector<Cell> cells = cells_of(header);
    std::vector<std::size_t> result;
    for (const std::string_view column : columns) {
        const auto found = std::ranges::find(cells, column, &Cell::text);
        if (found == cells.end())
            throw error(number, cells[0].at,
                        fmt::format("a header must have the columns {}, but this one has no \"{}\"",
                                    fmt::join(columns, ","), column));
        result.push_back(static_cast<std::size_t>(found - cells.begin()));
    }
    return result;
}

std::array<float, 6> numbers_below(std::span<const std::size_t> places, std::span<const std::string_view> columns,
                                   std::string_view line, std::size_t number) {
    const std::vector<Cell> cells = cells_of(line);
    std::array<float, 6> values{};
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::size_t at = places[i] < cells.size() ? cells[places[i]].at : line.size();
        const std::string text = places[i] < cells.size() ? cells[places[i]].text : "";
        std::size_t end = 0;
        if (!read_number(text, end, values[i]) || end != text.size())
            throw error(number, at, fmt::format("expected a finite number in the column \"{}\"", columns[i]));
    }
    return values;
}

std::array<float, 6> numbers_of(std::size_t count, std::string_view line, std::size_t number) {
    std::array<float, 6> values{};
    std::size_t at = skip_blanks(line, 0);
    for (std::size_t i = 0; i < count; ++i) {
        if (!read_number(line, at, values[i]))
            throw error(number, at, fmt::format("expected {} finite numbers", count));
        const std::size_t behind = at;
        at = skip_blanks(line, at);
        if (i + 1 == count) break;
        if (at < line.size() && line[at] == ',')
            at = skip_blanks(line, at + 1);
        else if (at == behind)
            throw error(number, at, fmt::format("expected {} finite numbers", count));
    }
    if (at < line.size() && line[at] != '#') throw error(number, at, fmt::format("more than {} numbers", count));
    return values;
}

}  // namespace

void for_each_line_of_numbers(std::istream& in, std::span<const std::string_view> columns,
                              const std::function<void(const std::array<float, 6>&, std::size_t)>& use) {
    std::string line;
    std::vector<std::size_t> below;  // a header
    bool is_first = true;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        const std::size_t at = skip_blanks(line, 0);
        if (at == line.size() || line[at] == '#') continue;
        if (std::exchange(is_first, false) && is_header(line, at)) {
            below = places(line, number, columns);
            continue;
        }
        use(below.empty() ? numbers_of(columns.size(), line, number) : numbers_below(below, columns, line, number),
            number);
    }
}

std::string csv_cell(std::string_view text) {
    const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos && !text.empty() &&
                          !is_blank(text.front()) && !is_blank(text.back());
    if (is_plain) return std::string(text);
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    return cell + '"';
}

}  // namespace phasetree::tracer
