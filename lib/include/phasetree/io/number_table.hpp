#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/error.hpp"

namespace phasetree {

/// Reads rows of numbers from text: CSV as written by spreadsheets, ParaView, R and NumPy, or plain lines of numbers.
/// Reads line by line, so that rows from a pipe can be used as they arrive.
///
/// Lines end with LF, CR LF or CR. A byte order mark, empty lines, lines that contain only separators, and lines that
/// begin with # are skipped. The decimal separator is a point.
///
/// With a header, columns may be in any order, and other columns are ignored. Names are not case-sensitive. The
/// separator is a comma, semicolon, tab or blank: the one with which the header has the most of the expected columns.
/// Cells may be quoted ("" stands for a quote), but must end on the same line; blanks around cells and inside quotes
/// are ignored.
///
/// Without a header, a row has the numbers of all columns in order, separated by commas, semicolons or blanks; # starts
/// a comment after them.
class NumberTable {
  public:
    struct Column {
        std::string_view name;  ///< in lower case
        bool is_required = true;
    };
    enum class Header { required, optional };

    /// `file` names the text in error messages. Column names must outlive the table.
    NumberTable(std::string file, std::span<const Column> columns, Header header)
        : file_(std::move(file)), columns_(columns.begin(), columns.end()), header_(header) {}

    /// Read the next line, without its line feed, and call use() if it is a row. A line that contains carriage returns
    /// is read as several lines. Throws SceneError with line and column.
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

    /// Whether a header was read. With Header::required, check this after the last line.
    bool has_header() const { return separator_ != no_header; }
    /// Whether rows have this column. Without a header they have all columns.
    bool has(std::size_t column) const;

    /// The number in a column of the current row, which must have that column. Number is float or double; numbers too
    /// small for it become 0. Throws SceneError unless the number is finite.
    template <class Number>
    Number number(std::size_t column) const;
    /// Make an error at a cell of the current row.
    SceneError error(std::size_t column, std::string message) const;

  private:
    struct Cell {
        std::size_t at;         ///< offset in the line
        std::string_view text;  ///< without quotes and surrounding blanks
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
    bool has_begun_ = false;           ///< whether a line was read that is neither empty nor a comment
    char separator_ = no_header;       ///< of rows below a header
    std::vector<std::size_t> places_;  ///< below a header: the cell index of each column, or `missing`
    std::size_t cells_in_header_ = 0;
    std::size_t line_number_ = 0;
    std::string_view line_;  ///< of the current row; valid during use()
    std::size_t row_end_ = 0;
    std::vector<Cell> cells_;
};

}  // namespace phasetree
