// Sources
//   gold, silver, copper:            Johnson & Christy, Optical constants of the noble metals, Phys. Rev. B 6 (1972)
//   chromium, iron, nickel, titanium: Johnson & Christy, Optical constants of transition metals, Phys. Rev. B 9 (1974)
//   aluminium: Rakić, Algorithm for the determination of intrinsic optical constants of metal films: application to
//              aluminum, Appl. Opt. 34 (1995)
//   brass:     Querry, Optical constants, contractor report CRDC-CR-85034 (1985), 70 % copper and 30 % zinc
//   tungsten:  Weaver, Olson & Lynch, Optical properties of crystalline tungsten, Phys. Rev. B 12 (1975)
#include "shading/metals.hpp"

#include <array>

namespace phasetree::tracer {

namespace {

// Reflectance at normal incidence in air in the last column.
const std::array table{
    Metal{"aluminium", {1.558f, 1.015f, 0.633f}, {7.712f, 6.627f, 5.454f}},  // 0.906 0.915 0.922
    Metal{"brass", {0.444f, 0.527f, 1.094f}, {3.695f, 2.765f, 1.829f}},      // 0.887 0.789 0.434
    Metal{"chromium", {3.107f, 3.181f, 2.323f}, {3.331f, 3.329f, 3.135f}},   // 0.556 0.555 0.555
    Metal{"copper", {0.238f, 1.007f, 1.240f}, {3.626f, 2.582f, 2.393f}},     // 0.935 0.624 0.538
    Metal{"gold", {0.156f, 0.424f, 1.383f}, {3.602f, 2.472f, 1.915f}},       // 0.957 0.792 0.408
    Metal{"iron", {2.911f, 2.950f, 2.584f}, {3.089f, 2.932f, 2.767f}},       // 0.531 0.512 0.496
    Metal{"nickel", {1.990f, 1.921f, 1.729f}, {4.209f, 3.616f, 2.944f}},     // 0.701 0.644 0.571
    Metal{"silver", {0.052f, 0.060f, 0.040f}, {4.409f, 3.597f, 2.648f}},     // 0.990 0.983 0.980
    Metal{"titanium", {2.741f, 2.542f, 2.267f}, {3.814f, 3.435f, 3.038f}},   // 0.616 0.582 0.544
    Metal{"tungsten", {3.671f, 3.522f, 3.315f}, {2.932f, 2.741f, 2.516f}},   // 0.517 0.496 0.469
};

}  // namespace

std::span<const Metal> metals() {
    return table;
}

std::optional<Metal> find_metal(std::string_view name) {
    if (name == "aluminum") name = "aluminium";
    for (const Metal& metal : table) {
        if (metal.name == name) return metal;
    }
    return std::nullopt;
}

}  // namespace phasetree::tracer
