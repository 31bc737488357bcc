#include "command/solve_report.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "command/streams.hpp"

namespace phasetree::tracer {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string_view sentence_of(SolveEnd end) {
    switch (end) {
        case SolveEnd::width:
            return "the bracket is as narrow as requested";
        case SolveEnd::undecided:
            return "32-bit coordinates allow no narrower bracket";
        case SolveEnd::same_side:
            return "both ends are on the same side";
        case SolveEnd::seconds:
            return "time ran out; allow more with --time";
        case SolveEnd::cancelled:
            return "interrupted";
    }
    return "";
}

bool is_finite(const Measured& m) {
    return std::isfinite(m.low) && std::isfinite(m.high);
}

// One line: a number and the quantity there.
void print_point(std::string_view what, const SolvePoint& point, const Quantity& q) {
    if (!is_finite(point.measure)) return put("{:<20}{:<14} not measured\n", what, point.at);
    put("{:<20}{:<14} {} = {:.7g} {}, {}\n", what, point.at, q.name, q.shown(point.measure.estimate), q.unit_name,
        interval_text(point.measure, q));
}

OrderedJson json_of_point(const SolvePoint& point, const Quantity& q) {
    OrderedJson json;
    json["at"] = point.at;
    const Measured& m = point.measure;
    if (is_finite(m))
        json["measure"] = {{"low", q.shown(m.low)}, {"high", q.shown(m.high)}, {"estimate", q.shown(m.estimate)}};
    else
        json["measure"] = nullptr;
    return json;
}

OrderedJson json_of_point(const std::optional<SolvePoint>& point, const Quantity& q) {
    return point ? json_of_point(*point, q) : OrderedJson();
}

}  // namespace

std::string interval_text(const Measured& m, const Quantity& q) {
    return fmt::format("from {:.9g} to {:.9g} {}", q.shown(m.low), q.shown(m.high), q.unit_name);
}

void print_solution(const SolveReport& report) {
    const SolveResult& r = report.result;
    const Quantity& q = report.quantity;
    put("{:<20}{}\n", "scene", report.scene);
    put("{:<20}{}\n", "number", report.pointer);
    if (report.seconds) put("{:<20}{} s\n", "time", *report.seconds);
    put("{:<20}{} = {:.9g} {}\n", "target", q.name, q.shown(q.target.value), q.unit_name);
    put("{:<20}{}\n", "stopped because", sentence_of(r.end));
    put("{:<20}{}\n\n", "measurements", r.measurements);
    if (r.best) print_point("value", *r.best, q);
    if (r.low) print_point("lower end", *r.low, q);
    if (r.high) print_point("upper end", *r.high, q);
    if (r.undecided) print_point("undecided", *r.undecided, q);
    if (!r.has_bracket()) return;
    put("\nEach line has an estimate of the measure, and an interval that is guaranteed to contain it. At one end of\n"
        "the bracket, the interval is below the target, and at the other above it. The measure has the target value\n"
        "at least once in between.\n");
}

void print_solution_json(const SolveReport& report) {
    const SolveResult& r = report.result;
    const Quantity& q = report.quantity;
    OrderedJson json;
    json["scene"] = report.scene;
    json["number"] = report.pointer;
    if (report.seconds) json["seconds"] = *report.seconds;
    json["quantity"] = q.name;
    json["unit"] = q.unit_name;
    json["target"] = q.shown(q.target.value);
    json["stopped"] = name_of(r.end);
    json["measurements"] = r.measurements;
    json["value"] = json_of_point(r.best, q);
    json["low"] = json_of_point(r.low, q);
    json["high"] = json_of_point(r.high, q);
    json["undecided"] = json_of_point(r.undecided, q);
    put("{}\n", json.dump(2));
}

}  // namespace phasetree::tracer
