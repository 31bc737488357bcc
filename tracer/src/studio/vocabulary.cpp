#include "studio/vocabulary.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "phasetree/io/suggest.hpp"
#include "scene/phase_entry.hpp"
#include "scene/reference.hpp"

namespace phasetree::tracer::studio {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view definitions = "#/definitions/";

// What a schema refers to, such as "field".
std::string reference_in(const Json& schema) {
    if (!schema.is_object() || !schema.contains("$ref")) return "";
    const std::string target = schema["$ref"];
    return target.starts_with(definitions) ? target.substr(definitions.size()) : "";
}

// Adds the alternatives of a schema; nested anyOf are flattened.
void add_alternatives(const Json& schema, std::vector<Json>& all) {
    if (!schema.contains("anyOf")) {
        all.push_back(schema);
        return;
    }
    for (const Json& one : schema["anyOf"]) add_alternatives(one, all);
}

// The type whose kinds are listed in this definition of the schema. Usually both have the same name.
std::string type_of_reference(const std::string& reference) {
    if (reference == "expectation") return "statement";
    return reference == "phase" ? "material" : reference;
}

void set_limits(const Json& schema, KindParameter& p) {
    const auto limit = [&](const char* key, std::optional<double>& value, bool& is_open, bool opens) {
        if (!schema.contains(key)) return;
        value = schema[key].get<double>();
        is_open = opens;
    };
    limit("minimum", p.low, p.low_is_open, false);
    limit("exclusiveMinimum", p.low, p.low_is_open, true);
    limit("maximum", p.high, p.high_is_open, false);
    limit("exclusiveMaximum", p.high, p.high_is_open, true);
}

std::string control_of_number(const KindParameter& p) {
    if (p.unit == "m") return "length";
    return p.unit == "degrees" ? "angle" : "number";
}

// The control for an array of three numbers, inferred from the unit, the limits and the wording of the reference.
std::string control_of_vector(const KindParameter& p) {
    const bool has_any_length = p.help.find("any length") != std::string::npos;
    if (p.type.find("not all zero") != std::string::npos || has_any_length) return "direction";
    return p.unit == "m" && !p.low_is_open && (!p.low || *p.low != 0) ? "point" : "vector";
}

// The control that edits values written as this schema says; empty if there is none, as for nested lists.
std::string control_of(const Json& schema, KindParameter& p) {
    if (schema.contains("enum")) {
        for (const Json& one : schema["enum"]) p.choices.push_back(one);
        return "choice";
    }
    if (schema.contains("pattern")) return "color";
    const std::string type = schema.value("type", "");
    if (type == "boolean") return "boolean";
    if (type == "string") return p.type == "name of a file" ? "file" : "text";
    if (type == "integer" || type == "number") {
        set_limits(schema, p);
        return type == "integer" ? "integer" : control_of_number(p);
    }
    if (type != "array" || schema.value("minItems", 0) != schema.value("maxItems", -1)) return "";
    std::vector<Json> items;
    add_alternatives(schema["items"], items);
    for (const Json& item : items)
        if (item.is_object() && item.value("type", "") == "number") {
            set_limits(item, p);
            return control_of_vector(p);
        }
    return "";
}

// What the stops of a ramp refer to: "texture" for a list of [number, texture].
std::string reference_at_stops(const Json& schema) {
    if (schema.value("type", "") != "array" || !schema["items"].is_object()) return "";
    const Json& stop = schema["items"];
    if (!stop.contains("items") || !stop["items"].is_array() || stop["items"].size() != 2) return "";
    return reference_in(stop["items"][1]);
}

bool is_of_phases(const ParameterPage& entry, const std::string& chapter) {
    if (entry.type == "phase" || entry.type == "phase or list of phases" || entry.type == "list of phases") return true;
    // In statements, parameters that name phases have the type "text", so the type does not show that they name phases.
    return chapter == "statements" && entry.type.starts_with("text");
}

KindParameter parameter_of(const ParameterPage& entry, const std::string& chapter) {
    KindParameter p;
    p.name = entry.name;
    p.unit = entry.unit;
    p.help = entry.description;
    p.type = entry.type;
    p.is_required = !entry.optional;
    if (entry.optional && Json::accept(entry.default_value)) p.default_value = entry.default_value;
    const Json schema = Json::parse(entry.schema);
    if (is_of_phases(entry, chapter)) {
        p.control = entry.type == "phase" || entry.type == "text" ? "phase" : "phases";
        return p;
    }
    std::vector<Json> alternatives;
    add_alternatives(schema, alternatives);
    std::string control;
    for (const Json& one : alternatives) {
        const std::string reference = reference_in(one);
        if (reference == "keys") {
            p.may_be_keyed = true;
        } else if (reference == "unit" || reference == "colour") {
            control = reference == "unit" ? "text" : "color";
        } else if (!reference.empty()) {
            if (reference == "texture") control = "color";  // a plain colour may be written for a texture
            p.slot = SlotType{type_of_reference(reference), false};
        } else if (one.value("type", "") == "array" && !reference_in(one["items"]).empty()) {
            p.slot = SlotType{type_of_reference(reference_in(one["items"])), true};
        } else if (const std::string at_stops = reference_at_stops(one); !at_stops.empty()) {
            p.slot = SlotType{at_stops, true};
        } else {
            // If a value can be written in several ways, the control is that of the first one.
            const std::string found = control_of(one, p);
            if (control.empty()) control = found.empty() ? "json" : found;
        }
    }
    if (entry.type.find("[nm, number]") != std::string::npos)
        control = "spectrum";
    else if (entry.type.starts_with("list of [number, "))
        control = "curve";
    p.control = control.empty() && p.slot ? "slot" : control.empty() ? "json" : control;
    return p;
}

// The type of a chapter's kinds, and whether they are written with their names.
struct ChapterType {
    std::string_view stem, type;
    bool is_written_with_name;
};

// A chapter missing here makes the constructor throw, and so fails every test of the studio. (type_of_chapter() handles
// the statements.)
constexpr std::array<ChapterType, 17> chapter_types{{{"scene-file", "scene", false},
                                                     {"placed-objects", "", false},
                                                     {"transforms", "transform", true},
                                                     {"shapes", "field", true},
                                                     {"operators-on-fields", "field", true},
                                                     {"objects", "object", true},
                                                     {"warps", "object", true},
                                                     {"materials", "material", true},
                                                     {"textures", "texture", true},
                                                     {"number-textures", "number_texture", true},
                                                     {"normal-maps", "normal_map", false},
                                                     {"phase-functions", "phase_function", true},
                                                     {"voxel-grids", "voxels", false},
                                                     {"lights", "light", true},
                                                     {"meshes", "mesh", true},
                                                     {"cameras", "camera", true},
                                                     {"render-settings", "render", false}}};

ChapterType type_of_chapter(const std::string& stem) {
    if (stem == "statements") return {"statements", "statement", true};
    for (const ChapterType& one : chapter_types)
        if (one.stem == stem) return one;
    throw std::logic_error("studio/vocabulary.cpp does not know the chapter " + stem);
}

CatalogueKind kind_of(const KindPage& entry, const std::string& chapter) {
    const ChapterType type = type_of_chapter(chapter);
    CatalogueKind kind;
    kind.name = entry.name;
    kind.chapter = chapter;
    kind.type = type.type;
    if (chapter == "placed-objects") kind.type = entry.name == "objects" ? "placed_object" : "instance";
    kind.summary = entry.summary;
    kind.equation = entry.equation;
    kind.section = entry.section;
    kind.picture = entry.example.starts_with("../") ? entry.example.substr(3)
                   : entry.example.empty()          ? ""
                                                    : "reference/" + entry.example;
    kind.is_written_with_name = type.is_written_with_name;
    for (const ParameterPage& p : entry.parameters) kind.parameters.push_back(parameter_of(p, chapter));
    const auto is_required = [](const KindParameter& p) { return p.is_required; };
    const bool is_one = std::count_if(kind.parameters.begin(), kind.parameters.end(), is_required) == 1;
    const bool is_node = kind.type == "field" || kind.type == "object";
    kind.has_short_form = is_node && is_one && entry.list_alone;
    const auto names = materials_for_meshes_only();
    kind.for_meshes_only = kind.type == "material" && std::find(names.begin(), names.end(), entry.name) != names.end();
    kind.relations = relations_of(kind.type, kind.name, [&](std::string_view key) { return kind.parameter(key); });
    return kind;
}

// The reference lists each warp once, as a node of objects. Returns the same warp as a node of fields, with a field as
// its child.
CatalogueKind of_fields(CatalogueKind kind) {
    kind.type = "field";
    for (KindParameter& p : kind.parameters)
        if (p.slot && p.slot->type == "object") p.slot->type = "field";
    return kind;
}

}  // namespace

const KindParameter* CatalogueKind::parameter(std::string_view key) const {
    for (const KindParameter& p : parameters)
        if (p.name == key || is_other_spelling(key, p.name)) return &p;
    return nullptr;
}

const KindParameter* CatalogueKind::lone_parameter() const {
    if (!has_short_form) return nullptr;
    for (const KindParameter& p : parameters)
        if (p.is_required) return &p;
    return nullptr;
}

Vocabulary::Vocabulary() {
    for (const Chapter& chapter : scene_chapters()) {
        const std::string stem = file_stem(chapter);
        for (const KindPage& entry : chapter.pages) {
            CatalogueKind kind = kind_of(entry, stem);
            if (stem == "warps") kinds_.push_back(of_fields(kind));
            kinds_.push_back(std::move(kind));
        }
    }
    for (std::size_t i = 0; i < kinds_.size(); ++i) by_type_[kinds_[i].type].emplace(kinds_[i].name, i);
    // A mesh takes an "opaque_material", whose kinds are looked up among those of "material". These include the clear
    // ones, which the reader of scenes rejects.
    by_type_["opaque_material"] = by_type_["material"];
}

const CatalogueKind* Vocabulary::find(std::string_view type, std::string_view name) const {
    const auto names = by_type_.find(type);
    if (names == by_type_.end()) return nullptr;
    for (const auto& [key, i] : names->second)
        if (key == name || is_other_spelling(name, key)) return &kinds_[i];
    return nullptr;
}

const CatalogueKind* Vocabulary::only(std::string_view type) const {
    const auto names = by_type_.find(type);
    if (names == by_type_.end() || names->second.size() != 1) return nullptr;
    const CatalogueKind& kind = kinds_[names->second.begin()->second];
    return kind.is_written_with_name ? nullptr : &kind;
}

}  // namespace phasetree::tracer::studio
