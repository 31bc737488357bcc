#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/error.hpp"

namespace phasetree {

/// Rows of numbers in text: CSV as spreadsheets, ParaView, R and NumPy write it, or plain lines of numbers. It is read
/// line by line, so that rows from a pipe can be used as they come.
///
/// Lines end with LF, CR LF or CR. A byte order mark, empty lines and lines that begin with # are skipped.
///
/// With a header, columns may be in any order, and others may stand among them. Names are matched without regard to
/// case. Cells are separated by what separates the names: commas, or else semicolons, tabs or blanks. A cell may be
/// quoted ("" stands for a quote in it), but must end on its line; blanks around cells do not count. Without a header,
/// a row is the numbers of all columns in their order, separated by commas, semicolons or blanks; behind them, # begins
/// a comment. Numbers have a decimal point.
class NumberTable {
  public:
    struct Column {
        std::string_view name;  ///< in lower case
        bool is_required = true;
    };
    enum class Header { required, optional };

    /// `file` is what errors call the text. Column names must outlive the table.
    NumberTable(std::string file, std::span<const Column> columns, Header header)
        : file_(std::move(file)), columns_(columns.begin(), columns.end()), header_(header) {}

    /// Reads the next line, given without its line feed, and calls use() if it is a row. (If it has carriage returns,
    /// it is several lines.) Throws SceneError with line and column.
    template <class Use>
    void read_line(std::string_view line, Use&& use) {
        if (line.ends_with('\r')) line.remove_suffix(1);
        while (true) {
            const std::size_t end = line.find('\r');
            if (is_row(line.substr(0, end))) use();
            if (end == std::string_view::npos) break;
            line.remove_prefix(end + 1);
        }
    }

    /// Whether the header was read that Header::required asks for.
    bool has_header() const { return separator_ != no_header; }
    /// Whether rows have this column. Without a header they have all of them.
    bool has(std::size_t column) const;

    /// The number that the current row has in a column, which it must have. Throws SceneError unless it is finite.
    /// Number is float or double; numbers that are too small for it are 0.
    template <class Number>
    Number number(std::size_t column) const;
    /// An error at the cell of a column in the current row.
    SceneError error(std::size_t column, std::string message) const;

  private:
    struct Cell {
        std::size_t at;         ///< offset in the line
        std::string_view text;  ///< without blanks and quotes around it
    };
    static constexpr char no_header = '\0';
    static constexpr std::size_t missing = static_cast<std::size_t>(-1);

    bool is_row(std::string_view line);
    bool is_header(std::string_view line);
    void read_header();
    void split(char separator);
    void split_without_header();
    Cell quoted_cell(std::size_t& at, char separator) const;
    void check_row() const;
    const Cell* cell(std::size_t column) const;
    SceneError error_at(std::size_t offset, std::string message) const;
    std::string required_names() const;

    std::string file_;
    std::vector<Column> columns_;
    Header header_;
    bool has_begun_ = false;           ///< whether there was a line that is neither empty nor a comment
    char separator_ = no_header;       ///< in rows below a header
    std::vector<std::size_t> places_;  ///< below a header: for each column the number of its cell, or `missing`
    std::size_t cells_in_header_ = 0;
    std::size_t line_number_ = 0;
    std::string_view line_;  ///< of the current row, valid while use() runs
    std::size_t row_end_ = 0;
    std::vector<Cell> cells_;
};

}  // namespace phasetree
