#include "studio/templates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace phasetree::tracer::studio {

namespace {

// A better initial value for a parameter than its type suggests. If an entry names the kind, the parameter is written
// even if it is optional.
struct Preferred {
    std::string_view kind;  // "name" or "type/name", such as "texture/field"; empty for all kinds
    std::string_view parameter, text;
};

constexpr std::string_view small_ball = R"({"sphere": {"radius": 0.05}})";
constexpr std::string_view filled_small_ball = R"({"set": {"phase": "<phase>", "of": {"sphere": {"radius": 0.05}}}})";
constexpr std::string_view other_ball =
    R"({"set": {"phase": "<other phase>", "of": {"translate": {"by": [0.4, 0, 0], "of": {"sphere": {"radius": 0.4}}}}}})";
constexpr std::string_view two_balls =
    R"({"over": [{"set": {"phase": "<phase>", "of": {"sphere": {"radius": 0.5}}}}, )"
    R"({"set": {"phase": "<other phase>", "of": {"translate": {"by": [0.4, 0, 0], "of": {"sphere": {"radius": 0.4}}}}}}]})";

constexpr Preferred preferred[] = {
    // Shapes.
    {"rounded_box", "radius", "0.1"},
    {"capped_cone", "radius_top", "0.25"},
    {"capsule", "from", "[-0.3, 0, 0]"},
    {"capsule", "to", "[0.3, 0, 0]"},
    {"capsule", "radius", "0.2"},
    {"plane", "normal", "[0, 0, 1]"},
    {"plane", "offset", "0"},
    {"torus", "minor", "0.15"},
    {"capped_torus", "minor", "0.1"},
    {"capped_torus", "angle", "120"},
    {"ellipsoid", "radii", "[0.6, 0.4, 0.4]"},
    {"link", "length", "0.4"},
    {"link", "major", "0.3"},
    {"link", "minor", "0.1"},
    {"tube", "inner_radius", "0.4"},
    {"rounded_cylinder", "edge", "0.1"},
    {"round_cone", "from", "[0, 0, -0.3]"},
    {"round_cone", "radius_from", "0.35"},
    {"round_cone", "to", "[0, 0, 0.4]"},
    {"round_cone", "radius_to", "0.15"},
    {"spherical_cap", "cut", "0"},
    {"bowl", "thickness", "0.04"},
    {"bowl", "cut", "0"},
    {"box_frame", "thickness", "0.08"},
    {"slab", "thickness", "0.2"},
    {"gyroid", "thickness", "0.1"},
    {"schwarz_p", "thickness", "0.1"},
    {"schwarz_d", "thickness", "0.1"},
    {"voronoi_cells", "gap", "0.05"},
    {"voronoi_cells", "size", "0.5"},
    {"polyline", "points", "[[-0.5, 0, 0], [0, 0, 0.4], [0.5, 0, 0]]"},
    {"polyline", "radius", "0.08"},
    {"blob", "points", "[[-0.25, 0, 0], [0.25, 0, 0]]"},
    {"blob", "radii", "0.6"},
    {"balls", "centres", "[[-0.3, 0, 0], [0.3, 0, 0]]"},
    {"balls", "radii", "0.3"},
    {"star", "points", "5"},
    {"star", "inner_radius", "0.25"},
    {"prism", "sides", "6"},
    {"helix", "radius", "0.4"},
    {"helix", "pitch", "0.3"},
    {"helix", "turns", "3"},
    {"helix", "wire_radius", "0.06"},
    {"heightfield", "size", "0.5"},
    {"heightfield", "amplitude", "0.1"},
    {"height_map", "size_x", "1"},
    {"height_map", "size_y", "1"},
    {"height_map", "height", "0.2"},
    {"polygon", "points", "[[-0.5, -0.4], [0.5, -0.4], [0, 0.5]]"},
    {"bezier", "points", "[[-0.5, 0], [-0.5, 0.5], [0, 0.5], [0.5, 0.5], [0.5, 0], [0, -0.7]]"},
    {"formula", "text", "\"x^2 + y^2 + z^2 - 0.25\""},
    {"formula", "bounds", "[[-0.6, -0.6, -0.6], [0.6, 0.6, 0.6]]"},
    {"polyhedron", "normals", "[[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]"},
    {"polyhedron", "offsets", "0.5"},
    {"text", "text", "\"Text\""},
    // Operators, copies and warps.
    {"offset", "distance", "0.05"},
    {"instances", "positions", "[[-0.6, 0, 0], [0.6, 0, 0]]"},
    {"field/polar_array", "of", "{\"translate\": {\"by\": [1, 0, 0], \"of\": {\"sphere\": {\"radius\": 0.3}}}}"},
    {"grid", "spacing", "[1.2, 1.2, 1.2]"},
    {"grid", "count_x", "2"},
    {"endless_grid", "spacing", "[1.5, 1.5, 0]"},
    {"field/fibonacci_disk", "of", small_ball},
    {"object/fibonacci_disk", "of", filled_small_ball},
    {"fibonacci_disk", "count", "50"},
    {"field/fibonacci_sphere", "of", small_ball},
    {"object/fibonacci_sphere", "of", filled_small_ball},
    {"fibonacci_sphere", "count", "50"},
    {"field/scatter", "of", small_ball},
    {"object/scatter", "of", filled_small_ball},
    {"scatter", "count", "50"},
    {"level_of_detail", "errors", "[0.01]"},
    {"proxy", "error", "0.01"},
    {"proxy", "margin", "0.1"},
    {"bounding_volume", "margin", "0.1"},
    {"translate", "by", "[0, 0, 0.5]"},
    {"scale", "factor", "1"},
    {"mirror", "normal", "[1, 0, 0]"},
    {"twist", "rate", "45"},
    {"bend", "rate", "30"},
    {"taper", "rate", "0.3"},
    {"affine", "by", "[0, 0, 0.5]"},
    {"distort", "amplitude", "0.05"},
    {"displace", "amplitude", "0.02"},
    {"displace", "scale", "0.2"},
    {"", "half_thickness", "0.05"},
    {"layered", "thickness", "0.05"},
    {"layered_sequence", "thicknesses", "[0.05, 0.05]"},
    {"smooth_layered", "thickness", "0.05"},
    {"intersect_shape", "shape", "{\"plane\": {\"normal\": [0, 0, 1], \"offset\": 0}}"},
    {"subtract_shape", "shape", "{\"plane\": {\"normal\": [0, 0, -1], \"offset\": 0}}"},
    {"smooth_intersect_shape", "shape", "{\"plane\": {\"normal\": [0, 0, 1], \"offset\": 0}}"},
    {"smooth_subtract_shape", "shape", "{\"plane\": {\"normal\": [0, 0, -1], \"offset\": 0}}"},
    {"remove", "phases", "\"<phase>\""},
    {"close_gaps", "of", two_balls},
    {"close_gaps", "gap", "0.02"},
    {"interface", "of", two_balls},
    {"interfaces", "of", two_balls},
    {"contact", "b", other_ball},
    {"contacts", "b", other_ball},
    {"", "alpha", "0.5"},
    {"checker", "size", "0.25"},
    {"layers", "thicknesses", "0.2"},
    {"strata", "thicknesses", "0.2"},
    {"voronoi", "size", "0.3"},
    {"particles", "phases", "[\"<phase>\"]"},
    {"particles", "centres", "[[-0.3, 0, 0], [0.3, 0, 0]]"},
    {"particles", "radii", "[0.25]"},
    {"labels", "spacing", "[0.1, 0.1, 0.1]"},
    {"voxels", "spacing", "[0.1, 0.1, 0.1]"},  // for images; OpenVDB files have their own
    // Materials and textures.
    {"clear", "ior", "1.5"},
    {"conductor", "metal", "\"gold\""},
    {"conductor", "roughness", "0.1"},
    {"coated", "roughness", "0.1"},
    {"glowing", "radiance", "5"},
    {"principled", "base_color", "[0.8, 0.5, 0.3]"},
    {"material/mix", "second", "{\"conductor\": {\"metal\": \"iron\", \"roughness\": 0.3}}"},
    {"texture/field", "ramp", "[[-0.1, [0.8, 0.5, 0.3]], [0.1, [0.2, 0.3, 0.6]]]"},
    {"texture/per_copy", "ramp", "[[0, [0.8, 0.5, 0.3]], [1, [0.2, 0.3, 0.6]]]"},
    {"number_texture/field", "ramp", "[[-0.1, 0.1], [0.1, 0.5]]"},
    {"number_texture/per_copy", "ramp", "[[0, 0.1], [1, 0.5]]"},
    {"measured", "reflectance", "[[400, 0.2], [550, 0.5], [700, 0.8]]"},
    // Lights and cameras.
    {"gradient", "zenith", "[0.6, 0.7, 0.9]"},
    {"gradient", "horizon", "[0.8, 0.8, 0.8]"},
    {"gradient", "ground", "[0.2, 0.2, 0.2]"},
    {"sun", "direction", "[-1, -1, 2]"},
    {"portal", "centre", "[0, 3, 1]"},
    {"portal", "target", "[0, 0, 1]"},
    {"light/rectangle", "centre", "[-2, -2, 3]"},
    {"light/rectangle", "width", "1"},
    {"light/rectangle", "height", "1"},
    {"light/rectangle", "radiance", "[1, 1, 1]"},
    {"light/rectangle", "intensity", "60"},  // as bright as daylight in the scene's centre
    {"sphere", "centre", "[-2, -2, 3]"},
    {"spheres", "centres", "[[-2, -2, 3], [2, -2, 3]]"},
    {"", "target", "[0, 0, 0]"},
    {"sphere", "intensity", "30"},
    {"point", "intensity", "30"},
    {"spot", "intensity", "60"},
    {"ies", "intensity", "60"},
    {"point", "position", "[-2, -2, 3]"},
    {"spot", "position", "[-2, -2, 3]"},
    {"ies", "position", "[-2, -2, 3]"},
    {"", "position", "[0, -5, 2]"},
    {"", "look_at", "[0, 0, 0]"},
    {"orthographic", "height", "3"},
    // Statements and other parts.
    {"closed", "walls", "\"<phase>\""},
    {"closed", "around", "\"<other phase>\""},
    {"volume", "phase", "\"<phase>\""},
    {"volume", "at_least", "0.1"},
    {"mass", "phase", "\"<phase>\""},
    {"mass", "at_least", "0.1"},
    {"wall", "at_least", "0.01"},
    {"objects", "name", "\"object\""},
    {"objects", "tree", "{\"set\": {\"phase\": \"<phase>\", \"of\": {\"sphere\": {\"radius\": 0.5}}}}"},
    {"instance/instances", "of", "\"<object>\""},
    {"scene", "version", "1"},
    {"scene", "camera", "{\"position\": [0, -5, 2], \"look_at\": [0, 0, 0]}"},
};

std::string in_quotes(std::string_view text) {
    return fmt::format("\"{}\"", text);
}

// What stands in a slot.
std::string slot_text(const SlotType& slot) {
    const bool is_field = slot.type == "field";
    if (slot.type == "texture") return "[0.8, 0.5, 0.3]";
    if (slot.type == "number_texture") return "0.5";
    if (slot.type == "material" || slot.type == "opaque_material") return R"({"diffuse": {"color": [0.8, 0.5, 0.3]}})";
    if (slot.type == "phase_function") return R"({"henyey_greenstein": {"g": 0.5}})";
    if (slot.type == "transform") return R"({"translate": {"by": [0, 0, 0]}})";
    const std::string ball = R"({"sphere": {"radius": 0.5}})",
                      other = R"({"translate": {"by": [0.4, 0, 0], "of": {"sphere": {"radius": 0.4}}}})";
    const auto filled = [&](const std::string& field, std::string_view phase) {
        return is_field ? field : fmt::format(R"({{"set": {{"phase": "{}", "of": {}}}}})", phase, field);
    };
    if (!slot.is_list) return filled(ball, phase_placeholder);
    return fmt::format("[{}, {}]", filled(ball, phase_placeholder), filled(other, other_phase_placeholder));
}

// The preferred number if it is within the limits, otherwise some number that is.
double within(const KindParameter& p, double preferred) {
    const bool is_high_enough = !p.low || preferred > *p.low || (preferred == *p.low && !p.low_is_open),
               is_low_enough = !p.high || preferred < *p.high || (preferred == *p.high && !p.high_is_open);
    if (is_high_enough && is_low_enough) return preferred;
    if (p.low && p.high) return 0.5 * (*p.low + *p.high);
    return p.low ? *p.low + 1 : *p.high - 1;
}

// `is_first_phase`: no earlier parameter names a phase.
std::string value_of(const KindParameter& p, bool is_first_phase) {
    if (p.control == "slot") return slot_text(*p.slot);
    if (p.control == "phase") return in_quotes(is_first_phase ? phase_placeholder : other_phase_placeholder);
    if (p.control == "phases")
        return fmt::format("[{}, {}]", in_quotes(phase_placeholder), in_quotes(other_phase_placeholder));
    if (p.name == "radius" && p.help.starts_with("Blending radius")) return "0.1";
    if (p.control == "length") return fmt::format("{}", within(p, 0.5));
    if (p.control == "angle") return fmt::format("{}", within(p, 30));
    if (p.control == "number") return fmt::format("{}", within(p, 1));
    if (p.control == "integer") return fmt::format("{}", std::ceil(within(p, 5)));
    if (p.control == "vector") return "[1, 1, 1]";
    if (p.control == "point") return "[0, 0, 0]";
    if (p.control == "direction") return "[0, 0, 1]";
    if (p.control == "color") return "[0.8, 0.5, 0.3]";
    if (p.control == "boolean") return "true";
    if (p.control == "choice") return in_quotes(p.choices.front());
    if (p.control == "file") return in_quotes(file_placeholder);
    return "\"Text\"";
}

bool is_for(const Preferred& one, const CatalogueKind& kind, const KindParameter& p) {
    if (one.parameter != p.name) return false;
    if (one.kind.empty()) return p.is_required;
    return one.kind == kind.name || one.kind == kind.type + "/" + kind.name;
}

}  // namespace

std::string template_of(const CatalogueKind& kind) {
    std::string parameters;
    bool is_first_phase = true;
    for (const KindParameter& p : kind.parameters) {
        std::string text;
        for (const Preferred& one : preferred)
            if (text.empty() && is_for(one, kind, p)) text = one.text;
        if (text.empty() && p.is_required) text = value_of(p, is_first_phase);
        if (p.control == "phase") is_first_phase = false;
        if (!text.empty()) parameters += fmt::format("{}\"{}\": {}", parameters.empty() ? "" : ", ", p.name, text);
    }
    parameters = "{" + parameters + "}";
    return kind.is_written_with_name ? fmt::format("{{\"{}\": {}}}", kind.name, parameters) : parameters;
}

}  // namespace phasetree::tracer::studio
