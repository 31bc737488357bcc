#include "scene/parameter_relations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

namespace {

// "a", or "a" or "b".
std::string named_in(const Requirement& r) {
    std::string text;
    for (std::size_t i = 0; i < std::min(r.named, r.any_of.size()); ++i)
        text += fmt::format("{}\"{}\"", i == 0 ? "" : " or ", r.any_of[i]);
    return text;
}

void append(ParameterRelations& all, const ParameterRelations& more) {
    all.exclusive.insert(all.exclusive.end(), more.exclusive.begin(), more.exclusive.end());
    all.requirements.insert(all.requirements.end(), more.requirements.begin(), more.requirements.end());
    if (more.one_of.empty()) return;
    all.one_of = more.one_of;
    all.initial = more.initial;
}

}  // namespace

const ParameterRelations& relations_of_clear() {
    static const std::vector<std::string_view> scattering{"scattering", "albedo", "medium"};
    static const std::vector<std::string_view> attenuation{"scattering", "absorption", "albedo",
                                                           "medium",     "color",      "absorption_spectrum"};
    constexpr std::string_view white = "[1, 1, 1]", density = R"({"sphere": {"radius": 0.5}})";
    static const ParameterRelations relations{
        .exclusive = {{"absorption", "color", "absorption_spectrum", "medium", "albedo"},
                      {"scattering", "medium", "albedo"},
                      {"density", "density_grid"},
                      {"emission_spectrum", "temperature_grid"},
                      {"anisotropy", "phase_function"},
                      {"ior", "glass"},
                      {"abbe_number", "glass"}},
        .requirements = {{"albedo", {"mean_free_path"}, "[0.1, 0.1, 0.1]"},
                         {"mean_free_path", {"albedo"}, "[0.9, 0.9, 0.9]"},
                         {"medium", {"scale"}, "25"},
                         {"scale", {"medium"}, "\"whole_milk\""},
                         {"anisotropy", scattering, white},
                         {"phase_function", scattering, white},
                         {"density", attenuation, white, 2},
                         {"density", {"density_depth"}, "0.1"},
                         {"density_depth", {"density"}, density},
                         {"density_grid", attenuation, white, 2},
                         {"emission_spectrum", {"emission"}, white},
                         {"temperature_grid", {"emission"}, white},
                         {"temperature_grid", {"density_grid", "density"}, "", 2}},
        .one_of = {"ior", "glass"},
        .initial = "1.5"};
    return relations;
}

const ParameterRelations& relations_of_conductor() {
    static const ParameterRelations relations{
        .exclusive = {{"eta", "reflectance", "metal"}, {"k", "reflectance", "metal"}},
        .requirements = {{"eta", {"k"}, "[3, 3, 3]"}, {"k", {"eta"}, "[1, 1, 1]"}},
        .one_of = {"metal", "reflectance", "eta"},
        .initial = "\"gold\""};
    return relations;
}

const ParameterRelations& relations_of_thin_glass() {
    static const ParameterRelations relations{.requirements = {{"color_distance", {"thickness"}, "0.01"}}};
    return relations;
}

const ParameterRelations& relations_of_bumps() {
    static const ParameterRelations relations{
        .requirements = {
            {"bump", {"bump_height"}, "0.01"},
            {"bump_height", {"bump"}, R"({"speckle": {"color": [1, 1, 1], "other": [0, 0, 0], "grain": 0.02}})"}}};
    return relations;
}

const ParameterRelations& relations_of_normal_maps() {
    static const ParameterRelations relations{.exclusive = {{"bump", "normal_map"}}};
    return relations;
}

const ParameterRelations& relations_of_grain() {
    static const ParameterRelations relations{
        .exclusive = {{"grain_around", "grain_along"}},
        .requirements = {{"grain_through", {"grain_around"}, "[0, 0, 1]"},
                         {"grain_aspect", {"grain_along", "grain_around"}, "[1, 0, 0]", 2}}};
    return relations;
}

const ParameterRelations& relations_of_opacity() {
    static const ParameterRelations relations{.requirements = {{"opacity_cutoff", {"opacity"}, "0.5"}}};
    return relations;
}

ParameterRelations relations_of(std::string_view type, std::string_view kind,
                                const std::function<bool(std::string_view)>& has) {
    ParameterRelations all;
    if (type == "material") {
        if (kind == "clear") append(all, relations_of_clear());
        if (kind == "conductor") append(all, relations_of_conductor());
        if (kind == "thin_glass") append(all, relations_of_thin_glass());
        if (has("bump_height")) append(all, relations_of_bumps());
        if (has("normal_map")) append(all, relations_of_normal_maps());
        if (has("grain_along")) append(all, relations_of_grain());
    }
    if (type == "mesh" && has("opacity_cutoff")) append(all, relations_of_opacity());
    return all;
}

void check_relations(const ParameterRelations& relations, const std::function<bool(std::string_view)>& is_given) {
    for (const std::vector<std::string_view>& names : relations.exclusive) {
        std::string_view first;
        for (const std::string_view name : names) {
            if (!is_given(name)) continue;
            if (!first.empty())
                throw ParameterError(
                    name, fmt::format("\"{}\" and \"{}\" cannot be combined; remove one of them", name, first),
                    ParameterError::Place::key);
            first = name;
        }
    }
    for (const Requirement& r : relations.requirements)
        if (is_given(r.parameter) && std::none_of(r.any_of.begin(), r.any_of.end(), is_given))
            throw ParameterError(r.parameter, fmt::format("\"{}\" requires {}", r.parameter, named_in(r)),
                                 ParameterError::Place::key);
}

}  // namespace phasetree::tracer
