#include "command/measure_report.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "command/streams.hpp"

namespace phasetree::tracer {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
// The components of the tensor of inertia that are printed; the others follow by symmetry.
constexpr std::array<std::array<std::size_t, 2>, 6> components{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

std::string_view explanation_of(MeasureEnd end) {
    switch (end) {
        case MeasureEnd::tolerance:
            return "all volumes are within the tolerance";
        case MeasureEnd::precision:
            return "32-bit coordinates allow no narrower intervals";
        case MeasureEnd::seconds:
            return "time ran out; allow more with --time";
        case MeasureEnd::boxes:
            return "the maximum number of boxes was reached";
        case MeasureEnd::cancelled:
            return "interrupted";
        case MeasureEnd::enough:
            return "the question is answered";
    }
    return "";
}

bool is_known(const Measured& m) {
    return std::isfinite(m.low) && std::isfinite(m.high);
}

// A printed unit: its name, and its size in SI units.
struct PrintedUnit {
    std::string name;
    double size = 1;
};

// The units of the table, which follow from the scene's unit of length.
struct TableUnits {
    explicit TableUnits(const LengthUnit& u)
        : length{std::string(u.name), u.metres},
          area{fmt::format("{}²", u.name), std::pow(u.metres, 2)},
          volume{fmt::format("{}³", u.name), std::pow(u.metres, 3)},
          inertia{fmt::format("kg {}²", u.name), std::pow(u.metres, 2)},
          inertia_without_density{fmt::format("{}⁵", u.name), std::pow(u.metres, 5)} {}

    PrintedUnit length, area, volume, mass{"kg"}, inertia, inertia_without_density;
};

// One line: what it is, the estimate, and the interval.
void print(std::string_view what, const Measured& m, const PrintedUnit& unit) {
    if (!is_known(m)) return put("  {:<18}unknown\n", what);
    put("  {:<18}{:>14.7g} {:<6} from {:.9g} to {:.9g}\n", what, m.estimate / unit.size, unit.name, m.low / unit.size,
        m.high / unit.size);
}

void print_body(const Body& body, bool has_density, const TableUnits& units) {
    print("volume", body.volume, units.volume);
    if (has_density) print("mass", body.mass, units.mass);
    for (std::size_t i = 0; i < 3; ++i) print(fmt::format("centre of mass {}", axes[i]), body.centre[i], units.length);
}

void print_inertia(const Body& body, bool has_density, const TableUnits& units) {
    for (const auto& [i, j] : components)
        print(fmt::format("inertia {}{}", axes[i], axes[j]), body.inertia[i][j],
              has_density ? units.inertia : units.inertia_without_density);
}

void print_thickness(const WallThickness& w, const PrintedUnit& length) {
    const double k = 1 / length.size;
    if (!w.place) return put("  {:<18}at least {:.5g} {} everywhere\n", "thickness", w.low * k, length.name);
    const glm::dvec3 place = glm::dvec3(*w.place) * k;
    // The search ends by itself once the two bounds are within 5 %.
    const bool is_cut_short = w.high > 1.051 * w.low;
    put("  {:<18}from {:.5g} to {:.5g} {} where it is thinnest, at ({:.6g}, {:.6g}, {:.6g}){}\n", "thickness",
        w.low * k, w.high * k, length.name, place.x, place.y, place.z,
        is_cut_short ? "; the search was cut short, so allow more with --time" : "");
}

void print_phase(const MeasureReport& report, const MeasuredPhase& p, const TableUnits& units) {
    put("\n{}\n", report.names[p.phase]);
    print_body(p.body, p.has_density, units);
    for (std::size_t i = 0; i < 3; ++i) print(fmt::format("smallest {}", axes[i]), p.box_low[i], units.length);
    for (std::size_t i = 0; i < 3; ++i) print(fmt::format("largest {}", axes[i]), p.box_high[i], units.length);
    print_inertia(p.body, p.has_density, units);
    for (const AreaResult::OfPhase& a : report.areas.phases)
        if (a.phase == p.phase)
            put("  {:<18}{:>14.5g} {:<6} standard error {:.2g}\n", "area", a.area / units.area.size, units.area.name,
                a.standard_error / units.area.size);
    for (const WallThickness& w : report.walls)
        if (w.phase == p.phase) print_thickness(w, units.length);
}

Json json_of(const Measured& m) {
    if (!is_known(m)) return nullptr;
    return {{"low", m.low}, {"high", m.high}, {"estimate", m.estimate}};
}

Json json_of(const std::array<Measured, 3>& all) {
    return {json_of(all[0]), json_of(all[1]), json_of(all[2])};
}

// The limits are null if nothing is proved.
Json json_of(const WallThickness& w) {
    Json json{{"low", w.low > 0 ? Json(w.low) : Json()}, {"high", w.place ? Json(w.high) : Json()}};
    json["at"] = w.place ? Json{w.place->x, w.place->y, w.place->z} : Json();
    return json;
}

void add_body(Json& json, const Body& body, bool has_density) {
    json["volume"] = json_of(body.volume);
    if (has_density) json["mass"] = json_of(body.mass);
    json["centre"] = json_of(body.centre);
    json["inertia"] = {json_of(body.inertia[0]), json_of(body.inertia[1]), json_of(body.inertia[2])};
}

}  // namespace

void print_table(const MeasureReport& report) {
    const MeasureResult& m = report.measures;
    put("{:<20}{}\n", "scene", report.scene);
    put("{:<20}{}\n", "stopped because", explanation_of(m.end));
    put("{:<20}{}\n", "boxes", m.boxes);
    put("\nEach line has an estimate, and an interval that is guaranteed to contain the number. Areas are statistical\n"
        "estimates. Moments of inertia are about the centre of mass; phases without a density count with density 1.\n");
    const TableUnits units(report.unit);
    for (const MeasuredPhase& p : m.phases) print_phase(report, p, units);
    if (m.all) {
        put("\nall phases with a density\n");
        print_body(*m.all, true, units);
        print_inertia(*m.all, true, units);
    }
    if (report.areas.contacts.empty()) return;
    put("\n{:<34}{:>14} {:>16}\n", "contact", fmt::format("area in {}", units.area.name), "standard error");
    for (const AreaResult::OfContact& c : report.areas.contacts)
        put("{:<34}{:>14.5g} {:>16.2g}\n", fmt::format("{}, {}", report.names[c.first], report.names[c.second]),
            c.area / units.area.size, c.standard_error / units.area.size);
}

void print_json(const MeasureReport& report) {
    const MeasureResult& m = report.measures;
    Json json;
    json["scene"] = report.scene;
    json["stopped"] = name_of(m.end);
    json["boxes"] = m.boxes;
    json["lines"] = report.areas.lines;
    Json& list = json["phases"] = Json::array();
    for (const MeasuredPhase& p : m.phases) {
        Json phase;
        phase["name"] = report.names[p.phase];
        if (p.has_density) phase["density"] = p.density;
        add_body(phase, p.body, p.has_density);
        phase["box"] = {{"low", json_of(p.box_low)}, {"high", json_of(p.box_high)}};
        for (const AreaResult::OfPhase& a : report.areas.phases)
            if (a.phase == p.phase) phase["area"] = {{"estimate", a.area}, {"standard_error", a.standard_error}};
        for (const WallThickness& w : report.walls)
            if (w.phase == p.phase) phase["thickness"] = json_of(w);
        list.push_back(phase);
    }
    if (m.all) add_body(json["all"], *m.all, true);
    Json& contacts = json["contacts"] = Json::array();
    for (const AreaResult::OfContact& c : report.areas.contacts)
        contacts.push_back({{"phases", {report.names[c.first], report.names[c.second]}},
                            {"area", {{"estimate", c.area}, {"standard_error", c.standard_error}}}});
    put("{}\n", json.dump(2));
}

}  // namespace phasetree::tracer
