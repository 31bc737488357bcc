#include "phasetree/io/number_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "io/geometry/words.hpp"
#include "io/json/utf8.hpp"

namespace phasetree {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

// A blank that is not a separator.
bool is_padding(char c, char separator) {
    return is_blank(c) && c != separator;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    return lower;
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

// Whether a line has no cells, or only empty ones, as spreadsheets write empty rows.
bool is_empty(std::string_view line) {
    return line.find_first_not_of(" \t,;") == std::string_view::npos;
}

// Calls f with each cell of a header that may have any separator, so quotes need not be right.
template <class F>
void each_name(std::string_view header, char separator, const F& f) {
    bool is_quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= header.size(); ++i) {
        if (i < header.size() && header[i] == '"') is_quoted = !is_quoted;
        if (i < header.size() && (header[i] != separator || is_quoted)) continue;
        std::string_view name = without_blanks(header.substr(begin, i - begin));
        if (name.size() > 1 && name.starts_with('"') && name.ends_with('"')) name = name.substr(1, name.size() - 2);
        f(without_blanks(name));
        begin = i + 1;
    }
}

// The separator of a header's names: the one that separates most of the columns. Among equals, the first of comma,
// semicolon and tab that occurs outside quotes, or else a blank.
char separator_of(std::string_view header, std::span<const NumberTable::Column> columns) {
    char best = ' ';
    std::ptrdiff_t most = -1;
    for (const char separator : {',', ';', '\t', ' '}) {
        std::ptrdiff_t known = 0, cells = 0;
        each_name(header, separator, [&](std::string_view name) {
            known += std::ranges::count(columns, lower_case(name), &NumberTable::Column::name);
            ++cells;
        });
        if ((cells == 1 && separator != ' ') || known <= most) continue;
        best = separator;
        most = known;
    }
    return best;
}

// Whether the first cell of a line looks like a name rather than a number.
bool looks_like_name(std::string_view text) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const std::string word = lower_case({text.begin(), std::ranges::find_if_not(text, is_letter)});
    if (word == "nan" || word == "inf" || word == "infinity") return false;
    return !word.empty() || text.empty() || text.front() == '_';
}

}  // namespace

bool NumberTable::is_row(std::string_view line) {
    if (++line_number_ == 1 && line.starts_with(io::byte_order_mark)) line.remove_prefix(io::byte_order_mark.size());
    line_ = line;
    if (is_empty(line) || without_blanks(line).starts_with('#')) return false;
    if (!std::exchange(has_begun_, true) && is_header(line)) {
        read_header();
        return false;
    }
    if (has_header())
        split(separator_);
    else
        split_without_header();
    check_row();
    return true;
}

bool NumberTable::is_header(std::string_view line) {
    if (header_ == Header::required) return true;
    // Lines of numbers have no quotes, so splitting them here cannot fail.
    split(separator_of(line, columns_));
    const auto is_column = [&](const Cell& cell) {
        return std::ranges::find(columns_, lower_case(cell.text), &Column::name) != columns_.end();
    };
    const std::string_view first = cells_.front().text;
    return !io::number_of<double>(first) && (std::ranges::any_of(cells_, is_column) || looks_like_name(first));
}

void NumberTable::read_header() {
    separator_ = separator_of(line_, columns_);
    split(separator_);
    cells_in_header_ = cells_.size();
    places_.assign(columns_.size(), missing);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const auto column = std::ranges::find(columns_, lower_case(cells_[i].text), &Column::name);
        if (column == columns_.end()) continue;
        std::size_t& place = places_[static_cast<std::size_t>(column - columns_.begin())];
        if (place != missing) throw error_at(cells_[i].at, fmt::format("the column \"{}\" occurs twice", column->name));
        place = i;
    }
    for (std::size_t i = 0; i < columns_.size(); ++i)
        if (columns_[i].is_required && places_[i] == missing)
            throw error_at(cells_.front().at, fmt::format("the header lacks the column \"{}\"; it must name {}",
                                                          columns_[i].name, required_names()));
}

std::string NumberTable::required_names() const {
    std::string names;
    for (const Column& column : columns_)
        if (column.is_required) names += (names.empty() ? "" : ", ") + std::string(column.name);
    return names;
}

// Reads the quoted cell that begins at `at`, and moves `at` to the separator after it, or to the end of the line.
NumberTable::Cell NumberTable::quoted_cell(std::size_t& at, char separator) const {
    const std::size_t begin = at++;
    while (at < line_.size() && (line_[at] != '"' || line_.substr(at).starts_with("\"\"")))
        at += line_[at] == '"' ? 2 : 1;
    if (at >= line_.size())
        throw error_at(begin, "a quoted cell must end on its line, but this one has no closing quote");
    const Cell cell{begin, without_blanks(line_.substr(begin + 1, at - begin - 1))};
    for (++at; at < line_.size() && is_padding(line_[at], separator); ++at) {
    }
    if (at < line_.size() && line_[at] != separator)
        throw error_at(at, "only a separator may follow the closing quote of a cell");
    return cell;
}

void NumberTable::split(char separator) {
    cells_.clear();
    std::size_t at = 0;
    while (true) {
        const bool is_of_blanks = separator == ' ';
        while (at < line_.size() && (is_of_blanks ? is_blank(line_[at]) : is_padding(line_[at], separator))) ++at;
        if (is_of_blanks && at == line_.size() && !cells_.empty()) break;
        if (at < line_.size() && line_[at] == '"') {
            cells_.push_back(quoted_cell(at, separator));
        } else {
            const std::string_view rest = line_.substr(at);
            const std::string_view text =
                rest.substr(0, is_of_blanks ? rest.find_first_of(" \t") : rest.find(separator));
            cells_.push_back({at, without_blanks(text)});
            at += text.size();
        }
        if (at == line_.size()) break;
        ++at;
    }
    row_end_ = line_.size();
}

void NumberTable::split_without_header() {
    cells_.clear();
    const auto skip_blanks = [&](std::size_t at) { return std::min(line_.find_first_not_of(" \t", at), line_.size()); };
    const auto is_end = [&](std::size_t at) { return at == line_.size() || line_[at] == '#'; };
    std::size_t at = skip_blanks(0);
    std::optional<char> first_separator;
    while (true) {
        const std::size_t end = std::min(line_.find_first_of(" \t,;#", at), line_.size());
        cells_.push_back({at, line_.substr(at, end - at)});
        at = skip_blanks(end);
        if (is_end(at)) break;
        const char separator = line_[at] == ',' || line_[at] == ';' ? line_[at] : ' ';
        // "0,5 1,5" is not a row of four numbers.
        if (separator != first_separator.value_or(separator))
            throw error_at(end, "numbers must use a decimal point, and the same separator must be used throughout");
        first_separator = separator;
        // A comma is always followed by a cell, even if that is empty.
        if (separator != ' ') at = skip_blanks(at + 1);
    }
    row_end_ = at;
}

void NumberTable::check_row() const {
    if (!has_header()) {
        // Report the first problem in the line first.
        for (std::size_t i = 0; i < std::min(columns_.size(), cells_.size()); ++i) (void)number<double>(i);
        if (cells_.size() < columns_.size())
            throw error_at(row_end_, fmt::format("expected {} finite numbers", columns_.size()));
        if (cells_.size() > columns_.size())
            throw error_at(cells_[columns_.size()].at, fmt::format("more than {} numbers", columns_.size()));
        return;
    }
    for (std::size_t i = cells_in_header_; i < cells_.size(); ++i)
        if (!cells_[i].text.empty())
            throw error_at(cells_[i].at,
                           fmt::format("the row has {} cells, but the header has {}", cells_.size(), cells_in_header_));
}

const NumberTable::Cell* NumberTable::cell(std::size_t column) const {
    const std::size_t place = has_header() ? places_[column] : column;
    return place < cells_.size() ? &cells_[place] : nullptr;
}

bool NumberTable::has(std::size_t column) const {
    return !has_header() || places_[column] != missing;
}

template <class Number>
Number NumberTable::number(std::size_t column) const {
    const Cell* const found = cell(column);
    if (found)
        if (const auto value = io::number_of<Number>(found->text)) return *value;
    if (!has_header()) throw error(column, fmt::format("expected {} finite numbers", columns_.size()));
    const std::string_view name = columns_[column].name;
    if (!found || found->text.empty()) throw error(column, fmt::format("the row has no {}", name));
    std::string with_point(found->text);
    std::ranges::replace(with_point, ',', '.');
    const bool has_decimal_comma = with_point != found->text && io::number_of<Number>(with_point);
    throw error(column, fmt::format("{} must be a finite number, but is {}{}", name, io::in_quotes(found->text),
                                    has_decimal_comma ? "; use a decimal point" : ""));
}

template float NumberTable::number(std::size_t) const;
template double NumberTable::number(std::size_t) const;

SceneError NumberTable::error(std::size_t column, std::string message) const {
    const Cell* const found = cell(column);
    return error_at(found ? found->at : row_end_, std::move(message));
}

SceneError NumberTable::error_at(std::size_t offset, std::string message) const {
    std::size_t column = 1;
    for (std::size_t at = 0; at < offset && at < line_.size(); at += io::decode(line_, at).bytes) ++column;
    return {file_, line_number_, column, std::move(message)};
}

}  // namespace phasetree
