// Coefficients of Sellmeier's equation for the named substances of scene files.
//
// Sources:
// - bk7, f2, sf11: Schott, optical glass data sheets (N-BK7, F2, N-SF11), 2017.
// - diamond: Peter, Über Brechungsindizes und Absorptionskonstanten des Diamanten, Zeitschrift für Physik 15, 1923.
// - fused_silica: Malitson, Interspecimen comparison of the refractive index of fused silica, JOSA 55, 1965.
// - sapphire, its ordinary ray: Malitson & Dodge, Refractive index and birefringence of synthetic sapphire, JOSA 62,
//   1972; Dodge, Handbook of Laser Science and Technology IV, 1986.
// - water, at 20 °C: Daimon & Masumura, Measurement of the refractive index of distilled water, Applied Optics 46,
//   2007.
#include "spectrum/glasses.hpp"

#include <algorithm>
#include <array>

namespace phasetree::tracer {

namespace {

constexpr double squared(double x) {
    return x * x;
}

Glass glass(std::string_view name, const Dispersion::Sellmeier& terms) {
    return {name, Dispersion(terms)};
}

const std::array table{
    glass("bk7", {{{1.03961212, 0.00600069867}, {0.231792344, 0.0200179144}, {1.01046945, 103.560653}}}),
    glass("diamond", {{{0.3306, squared(0.1750)}, {4.3356, squared(0.1060)}}}),
    glass("f2", {{{1.34533359, 0.00997743871}, {0.209073176, 0.0470450767}, {0.937357162, 111.886764}}}),
    glass("fused_silica",
          {{{0.6961663, squared(0.0684043)}, {0.4079426, squared(0.1162414)}, {0.8974794, squared(9.896161)}}}),
    glass("sapphire",
          {{{1.4313493, squared(0.0726631)}, {0.65054713, squared(0.1193242)}, {5.3414021, squared(18.028251)}}}),
    glass("sf11", {{{1.73759695, 0.013188707}, {0.313747346, 0.0623068142}, {1.89878101, 155.23629}}}),
    glass("water", {{{0.5684027565, 0.005101829712},
                     {0.1726177391, 0.01821153936},
                     {0.02086189578, 0.02620722293},
                     {0.1130748688, 10.69792721}}}),
};

}  // namespace

std::span<const Glass> glasses() {
    return table;
}

std::optional<Glass> find_glass(std::string_view name) {
    const auto found = std::ranges::find(table, name, &Glass::name);
    return found == table.end() ? std::nullopt : std::optional(*found);
}

}  // namespace phasetree::tracer
