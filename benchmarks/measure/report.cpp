#include "measure/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace phasetree::bench {

namespace {

std::string printed(const Table::Cell& cell, const Column& column) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    const auto* spread = std::get_if<Spread>(&cell);
    return fmt::format(fmt::runtime(column.format), column.factor * (spread ? spread->median : std::get<double>(cell)));
}

nlohmann::ordered_json as_json(const Table::Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (const auto* spread = std::get_if<Spread>(&cell))
        return {{"median", spread->median}, {"low", spread->low}, {"high", spread->high}};
    return std::get<double>(cell);
}

// Counts characters, not bytes, because headings have "×" and "µ".
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string aligned(const std::string& text, std::size_t width, bool left) {
    const std::string pad(width - std::min(width, width_of(text)), ' ');
    return left ? text + pad : pad + text;
}

void print(const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
}

}  // namespace

void Table::row(std::vector<Cell> cells) {
    if (cells.size() != columns_.size()) throw std::logic_error("a row does not have the columns of its table");
    rows_.push_back(std::move(cells));
}

Report::Report(std::string name, std::string title) : name_(std::move(name)) {
    json_["title"] = title;
    print(fmt::format("\n== {}: {}", name_, title));
}

void Report::say(const std::string& line) {
    json_["notes"].push_back(line);
    print(line);
}

void Report::table(const std::string& key, const Table& table) {
    keep(key, table);
    std::vector<std::size_t> widths;
    std::vector<std::vector<std::string>> texts;
    for (const Column& c : table.columns_) widths.push_back(width_of(c.heading));
    for (const auto& row : table.rows_) {
        auto& line = texts.emplace_back();
        for (std::size_t i = 0; i < row.size(); ++i) {
            line.push_back(printed(row[i], table.columns_[i]));
            widths[i] = std::max(widths[i], width_of(line.back()));
        }
    }
    const auto join = [&](auto&& text_of) {
        std::string line;
        for (std::size_t i = 0; i < widths.size(); ++i)
            line += (i == 0 ? "  " : "  ") + aligned(text_of(i), widths[i], table.columns_[i].format.empty());
        print(line);
    };
    join([&](std::size_t i) { return table.columns_[i].heading; });
    for (const auto& line : texts) join([&](std::size_t i) { return line[i]; });
}

void Report::keep(const std::string& key, const Table& table) {
    auto& list = json_[key] = nlohmann::ordered_json::array();
    for (const auto& row : table.rows_) {
        auto& object = list.emplace_back(nlohmann::ordered_json::object());
        for (std::size_t i = 0; i < row.size(); ++i) object[table.columns_[i].key] = as_json(row[i]);
    }
}

void Report::target(const std::string& what, double measured, double wanted, bool met, const char* sign,
                    const std::string& format) {
    json_["targets"].push_back({{"what", what}, {"measured", measured}, {"wanted", wanted}, {"met", met}});
    const std::string is = fmt::format(fmt::runtime(format), measured);
    const std::string should = fmt::format(fmt::runtime(format), wanted);
    print(fmt::format("  target {}: {} {} {}: {}", what, is, sign, should, met ? "met" : "missed"));
}

void Report::at_most(const std::string& what, double measured, double wanted, const std::string& format) {
    const bool met = measured <= wanted;
    target(what, measured, wanted, met, met ? "≤" : ">", format);
}

void Report::at_least(const std::string& what, double measured, double wanted, const std::string& format) {
    const bool met = measured >= wanted;
    target(what, measured, wanted, met, met ? "≥" : "<", format);
}

void Report::check(const std::string& what, bool holds, const std::string& found) {
    json_["checks"].push_back({{"what", what}, {"holds", holds}, {"found", found}});
    print(fmt::format("  check {}: {}: {}", what, found, holds ? "holds" : "FAILED"));
    sound_ = sound_ && holds;
}

}  // namespace phasetree::bench
