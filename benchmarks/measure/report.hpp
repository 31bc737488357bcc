// What a subcommand found: printed as it comes, and kept as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "measure/in_turn.hpp"

namespace phasetree::bench {

struct Column {
    std::string key;      // in the JSON
    std::string heading;  // in the table
    std::string format;   // of numbers, as fmt has it: "{:.2f}"; empty for texts
    double factor = 1;    // of numbers in the table; the JSON has them as they are
};

class Table {
  public:
    explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
    // A number is printed by its column's format, a text as it is; of a Spread the median, in the JSON all three.
    using Cell = std::variant<double, std::string, Spread>;
    void row(std::vector<Cell> cells);

  private:
    friend class Report;
    std::vector<Column> columns_;
    std::vector<std::vector<Cell>> rows_;
};

class Report {
  public:
    Report(std::string name, std::string title);

    // A line of explanation: what is compared, on which rays, how many, with how many threads.
    void say(const std::string& line);
    void table(const std::string& key, const Table&);
    // The same, without printing it: for plots.
    void keep(const std::string& key, const Table&);
    // Compares with what is wanted; the verdict is printed, and does not change the exit code.
    void at_most(const std::string& what, double measured, double wanted, const std::string& format = "{:.2f}");
    void at_least(const std::string& what, double measured, double wanted, const std::string& format = "{:.2f}");
    // A condition without which the measurement is meaningless. If it fails, so does the program.
    void check(const std::string& what, bool holds, const std::string& found);
    void number(const std::string& key, double value) { json_[key] = value; }

    const std::string& name() const { return name_; }
    const nlohmann::ordered_json& json() const { return json_; }
    bool sound() const { return sound_; }

  private:
    void target(const std::string& what, double measured, double wanted, bool met, const char* sign,
                const std::string& format);

    std::string name_;
    nlohmann::ordered_json json_;
    bool sound_ = true;
};

}  // namespace phasetree::bench
