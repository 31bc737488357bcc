// Sources
//   gold, silver, copper:            Johnson & Christy, Optical constants of the noble metals, Phys. Rev. B 6 (1972)
//   chromium, iron, nickel, titanium: Johnson & Christy, Optical constants of transition metals, Phys. Rev. B 9 (1974)
//   aluminium: Rakić, Algorithm for the determination of intrinsic optical constants of metal films: application to
//              aluminum, Appl. Opt. 34 (1995)
//   brass:     Querry, Optical constants, contractor report CRDC-CR-85034 (1985), 70 % copper and 30 % zinc
//   tungsten:  Weaver, Olson & Lynch, Optical properties of crystalline tungsten, Phys. Rev. B 12 (1975)
#include "shading/metals.hpp"

#include <algorithm>
#include <array>

namespace phasetree::tracer {

namespace {

constexpr MetalPoint aluminium[] = {
    {364.66f, 0.3988f, 4.3957f}, {413.28f, 0.5213f, 5.0008f}, {442.8f, 0.6079f, 5.3676f},  {476.87f, 0.7278f, 5.7781f},
    {516.6f, 0.8734f, 6.2418f},  {563.57f, 1.0728f, 6.7839f}, {619.93f, 1.366f, 7.4052f},  {652.25f, 1.5724f, 7.7354f},
    {688.81f, 1.8301f, 8.0601f}, {729.32f, 2.1606f, 8.3565f}, {774.91f, 2.6154f, 8.4914f}, {794.78f, 2.7675f, 8.3866f},
};
constexpr MetalPoint brass[] = {
    {380.0f, 1.487f, 1.818f}, {390.0f, 1.471f, 1.813f}, {400.0f, 1.445f, 1.805f}, {410.0f, 1.405f, 1.794f},
    {420.0f, 1.35f, 1.786f},  {430.0f, 1.278f, 1.784f}, {440.0f, 1.191f, 1.797f}, {450.0f, 1.094f, 1.829f},
    {460.0f, 0.994f, 1.883f}, {470.0f, 0.9f, 1.957f},   {480.0f, 0.816f, 2.046f}, {490.0f, 0.745f, 2.145f},
    {500.0f, 0.686f, 2.25f},  {510.0f, 0.639f, 2.358f}, {520.0f, 0.602f, 2.464f}, {530.0f, 0.573f, 2.568f},
    {540.0f, 0.549f, 2.668f}, {550.0f, 0.527f, 2.765f}, {560.0f, 0.505f, 2.86f},  {570.0f, 0.484f, 2.958f},
    {580.0f, 0.468f, 3.059f}, {590.0f, 0.46f, 3.159f},  {600.0f, 0.45f, 3.253f},  {610.0f, 0.452f, 3.345f},
    {620.0f, 0.449f, 3.434f}, {630.0f, 0.445f, 3.522f}, {640.0f, 0.444f, 3.609f}, {650.0f, 0.444f, 3.695f},
    {660.0f, 0.445f, 3.778f}, {670.0f, 0.444f, 3.86f},  {680.0f, 0.444f, 3.943f}, {690.0f, 0.445f, 4.025f},
    {700.0f, 0.446f, 4.106f}, {710.0f, 0.448f, 4.186f}, {720.0f, 0.45f, 4.266f},  {730.0f, 0.452f, 4.346f},
    {740.0f, 0.455f, 4.424f}, {750.0f, 0.457f, 4.501f}, {760.0f, 0.458f, 4.579f}, {770.0f, 0.46f, 4.657f},
    {780.0f, 0.464f, 4.737f},
};
constexpr MetalPoint chromium[] = {
    {368.0f, 1.87f, 2.69f}, {381.0f, 1.92f, 2.74f}, {397.0f, 2.0f, 2.83f},  {413.0f, 2.08f, 2.93f},
    {431.0f, 2.19f, 3.04f}, {451.0f, 2.33f, 3.14f}, {471.0f, 2.51f, 3.24f}, {496.0f, 2.75f, 3.3f},
    {521.0f, 2.94f, 3.33f}, {549.0f, 3.18f, 3.33f}, {582.0f, 3.22f, 3.3f},  {617.0f, 3.17f, 3.3f},
    {659.0f, 3.09f, 3.34f}, {704.0f, 3.05f, 3.39f}, {756.0f, 3.08f, 3.42f}, {821.0f, 3.2f, 3.48f},
};
constexpr MetalPoint copper[] = {
    {367.9f, 1.36f, 1.975f}, {381.5f, 1.33f, 2.045f}, {397.4f, 1.32f, 2.116f}, {413.3f, 1.28f, 2.207f},
    {430.5f, 1.25f, 2.305f}, {450.9f, 1.24f, 2.397f}, {471.4f, 1.25f, 2.483f}, {495.9f, 1.22f, 2.564f},
    {520.9f, 1.18f, 2.608f}, {548.6f, 1.02f, 2.577f}, {582.1f, 0.7f, 2.704f},  {616.8f, 0.3f, 3.205f},
    {659.5f, 0.22f, 3.747f}, {704.5f, 0.21f, 4.205f}, {756.0f, 0.24f, 4.665f}, {821.1f, 0.26f, 5.18f},
};
constexpr MetalPoint gold[] = {
    {367.9f, 1.48f, 1.895f}, {381.5f, 1.46f, 1.933f}, {397.4f, 1.47f, 1.952f}, {413.3f, 1.46f, 1.958f},
    {430.5f, 1.45f, 1.948f}, {450.9f, 1.38f, 1.914f}, {471.4f, 1.31f, 1.849f}, {495.9f, 1.04f, 1.833f},
    {520.9f, 0.62f, 2.081f}, {548.6f, 0.43f, 2.455f}, {582.1f, 0.29f, 2.863f}, {616.8f, 0.21f, 3.272f},
    {659.5f, 0.14f, 3.697f}, {704.5f, 0.13f, 4.103f}, {756.0f, 0.14f, 4.542f}, {821.1f, 0.16f, 5.083f},
};
constexpr MetalPoint iron[] = {
    {368.0f, 2.02f, 2.43f}, {381.0f, 2.12f, 2.5f},  {397.0f, 2.24f, 2.58f}, {413.0f, 2.35f, 2.65f},
    {431.0f, 2.48f, 2.71f}, {451.0f, 2.59f, 2.77f}, {471.0f, 2.67f, 2.82f}, {496.0f, 2.74f, 2.88f},
    {521.0f, 2.86f, 2.91f}, {549.0f, 2.95f, 2.93f}, {582.0f, 2.94f, 2.99f}, {617.0f, 2.88f, 3.05f},
    {659.0f, 2.92f, 3.1f},  {704.0f, 2.86f, 3.19f}, {756.0f, 2.87f, 3.28f}, {821.0f, 2.94f, 3.39f},
};
constexpr MetalPoint nickel[] = {
    {368.0f, 1.7f, 2.4f},   {381.0f, 1.72f, 2.48f}, {397.0f, 1.72f, 2.57f}, {413.0f, 1.7f, 2.69f},
    {431.0f, 1.71f, 2.82f}, {451.0f, 1.73f, 2.95f}, {471.0f, 1.78f, 3.09f}, {496.0f, 1.82f, 3.25f},
    {521.0f, 1.85f, 3.42f}, {549.0f, 1.92f, 3.61f}, {582.0f, 1.96f, 3.8f},  {617.0f, 1.99f, 4.02f},
    {659.0f, 1.99f, 4.26f}, {704.0f, 2.06f, 4.5f},  {756.0f, 2.13f, 4.73f}, {821.0f, 2.26f, 4.97f},
};
constexpr MetalPoint silver[] = {
    {367.9f, 0.07f, 1.657f}, {381.5f, 0.05f, 1.864f}, {397.4f, 0.05f, 2.07f},  {413.3f, 0.05f, 2.275f},
    {430.5f, 0.04f, 2.462f}, {450.9f, 0.04f, 2.657f}, {471.4f, 0.05f, 2.869f}, {495.9f, 0.05f, 3.093f},
    {520.9f, 0.05f, 3.324f}, {548.6f, 0.06f, 3.586f}, {582.1f, 0.05f, 3.858f}, {616.8f, 0.06f, 4.152f},
    {659.5f, 0.05f, 4.483f}, {704.5f, 0.04f, 4.838f}, {756.0f, 0.03f, 5.242f}, {821.1f, 0.04f, 5.727f},
};
constexpr MetalPoint titanium[] = {
    {368.0f, 1.9f, 2.9f},   {381.0f, 1.99f, 2.93f}, {397.0f, 2.08f, 2.95f}, {413.0f, 2.14f, 2.98f},
    {431.0f, 2.21f, 3.01f}, {451.0f, 2.27f, 3.04f}, {471.0f, 2.32f, 3.1f},  {496.0f, 2.36f, 3.19f},
    {521.0f, 2.44f, 3.3f},  {549.0f, 2.54f, 3.43f}, {582.0f, 2.6f, 3.58f},  {617.0f, 2.67f, 3.72f},
    {659.0f, 2.76f, 3.84f}, {704.0f, 2.86f, 3.96f}, {756.0f, 3.0f, 4.01f},  {821.0f, 3.21f, 4.01f},
};
constexpr MetalPoint tungsten[] = {
    {379.0f, 3.459f, 2.556f}, {386.6f, 3.458f, 2.49f},  {391.2f, 3.445f, 2.46f},  {393.0f, 3.438f, 2.449f},
    {400.2f, 3.406f, 2.415f}, {411.5f, 3.379f, 2.416f}, {411.8f, 3.378f, 2.416f}, {425.3f, 3.346f, 2.439f},
    {429.8f, 3.336f, 2.45f},  {442.6f, 3.317f, 2.489f}, {448.7f, 3.314f, 2.511f}, {465.0f, 3.325f, 2.574f},
    {469.4f, 3.332f, 2.591f}, {492.1f, 3.38f, 2.664f},  {493.7f, 3.384f, 2.668f}, {511.1f, 3.433f, 2.7f},
    {529.8f, 3.49f, 2.716f},  {532.7f, 3.497f, 2.719f}, {548.9f, 3.522f, 2.739f}, {570.5f, 3.524f, 2.787f},
    {573.9f, 3.526f, 2.794f}, {599.7f, 3.557f, 2.86f},  {602.4f, 3.562f, 2.866f}, {626.0f, 3.607f, 2.906f},
    {626.8f, 3.609f, 2.907f}, {646.0f, 3.657f, 2.925f}, {652.4f, 3.68f, 2.937f},  {657.2f, 3.697f, 2.943f},
    {671.2f, 3.746f, 2.937f}, {680.8f, 3.797f, 2.914f}, {684.9f, 3.818f, 2.904f}, {700.8f, 3.871f, 2.879f},
    {706.1f, 3.884f, 2.869f}, {717.3f, 3.896f, 2.85f},  {731.4f, 3.891f, 2.828f}, {752.8f, 3.862f, 2.788f},
    {754.9f, 3.857f, 2.784f}, {777.8f, 3.789f, 2.737f}, {781.7f, 3.772f, 2.731f},
};

Metal metal(std::string_view name, std::span<const MetalPoint> spectrum) {
    const MetalPoint red = index_at(spectrum, 650), green = index_at(spectrum, 550), blue = index_at(spectrum, 450);
    return {name, {red.eta, green.eta, blue.eta}, {red.k, green.k, blue.k}, spectrum};
}

const std::array table{
    metal("aluminium", aluminium), metal("brass", brass),       metal("chromium", chromium), metal("copper", copper),
    metal("gold", gold),           metal("iron", iron),         metal("nickel", nickel),     metal("silver", silver),
    metal("titanium", titanium),   metal("tungsten", tungsten),
};

}  // namespace

MetalPoint index_at(std::span<const MetalPoint> spectrum, float nanometres) {
    const auto above = std::ranges::upper_bound(spectrum, nanometres, {}, &MetalPoint::nanometres);
    if (above == spectrum.begin()) return {nanometres, above->eta, above->k};
    const auto below = above - 1;
    if (above == spectrum.end()) return {nanometres, below->eta, below->k};
    const float part = (nanometres - below->nanometres) / (above->nanometres - below->nanometres);
    return {nanometres, below->eta + part * (above->eta - below->eta), below->k + part * (above->k - below->k)};
}

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
