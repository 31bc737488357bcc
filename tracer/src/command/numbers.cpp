#include "command/numbers.hpp"

#include <istream>

namespace phasetree::tracer {

void for_each_row(std::istream& in, std::span<const NumberTable::Column> columns,
                  const std::function<void(const std::array<float, 6>&, const NumberTable&)>& use) {
    NumberTable table("<stdin>", columns, NumberTable::Header::optional);
    std::array<float, 6> values{};
    for (std::string line; std::getline(in, line);) {
        table.read_line(line, [&] {
            for (std::size_t i = 0; i < columns.size(); ++i) values[i] = table.number<float>(i);
            use(values, table);
        });
    }
}

std::string csv_cell(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos && !text.empty() &&
                          blanks.find(text.front()) == blanks.npos && blanks.find(text.back()) == blanks.npos;
    if (is_plain) return std::string(text);
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
    return cell + '"';
}

}  // namespace phasetree::tracer
