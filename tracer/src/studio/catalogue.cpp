#include "studio/catalogue.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "studio/measured_colours.hpp"
#include "studio/templates.hpp"

namespace phasetree::tracer::studio {

namespace {

using Json = nlohmann::ordered_json;

Json limit(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

Json slot_json(const SlotType& slot) {
    return {{"list", slot.is_list}, {"type", slot.type}};
}

Json parameter_json(const KindParameter& p) {
    Json json;
    json["name"] = p.name;
    json["control"] = p.control;
    json["type"] = p.type;
    json["low"] = limit(p.low);
    json["high"] = limit(p.high);
    json["low_open"] = p.low_is_open;
    json["high_open"] = p.high_is_open;
    json["unit"] = p.unit;
    json["default"] = p.default_value.empty() ? Json() : Json(p.default_value);
    json["choices"] = p.choices;
    json["help"] = p.help;
    json["required"] = p.is_required;
    json["may_be_keyed"] = p.may_be_keyed;
    json["instead"] = p.slot ? slot_json(*p.slot) : Json();
    return json;
}

Json relations_json(const ParameterRelations& relations) {
    Json json{{"exclusive", relations.exclusive}, {"requirements", Json::array()}, {"one_of", relations.one_of}};
    for (const Requirement& r : relations.requirements)
        json["requirements"].push_back({{"parameter", r.parameter}, {"any_of", r.any_of}, {"initial", r.initial}});
    json["initial"] = relations.initial;
    return json;
}

// "smooth_union" becomes "Smooth union".
std::string title_of(const CatalogueKind& kind) {
    std::string title = kind.name;
    for (char& c : title)
        if (c == '_') c = ' ';
    if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') title[0] = static_cast<char>(title[0] - 'a' + 'A');
    return title;
}

std::string help_of(const CatalogueKind& kind) {
    std::string help = kind.summary;
    if (!kind.equation.empty()) help += fmt::format("\n\n`{}`", kind.equation);
    if (!kind.section.empty()) help += fmt::format("\n\nSection {} of the paper.", kind.section);
    return help;
}

std::string picture_of(const CatalogueKind& kind) {
    return kind.picture.empty() ? "" : kind.picture + ".jpg";
}

Json kind_json(const CatalogueKind& kind, const std::optional<std::filesystem::path>& pictures) {
    Json json;
    json["kind"] = kind.name;
    json["chapter"] = kind.chapter;
    json["type"] = kind.type;
    json["keyed"] = kind.is_written_with_name;
    json["for_meshes_only"] = kind.for_meshes_only;
    json["title"] = title_of(kind);
    json["help"] = help_of(kind);
    const std::string picture = picture_of(kind);
    const bool has_picture = pictures && !picture.empty() && std::filesystem::exists(*pictures / picture);
    json["picture"] = has_picture ? Json("pictures/" + picture) : Json();
    json["template"] = template_of(kind);
    json["alone"] = Json();
    if (const KindParameter* lone = kind.lone_parameter()) json["alone"] = lone->name;
    json["parameters"] = Json::array();
    json["slots"] = Json::array();
    json["relations"] = relations_json(kind.relations);
    for (const KindParameter& p : kind.parameters) {
        if (p.control == "slot") {
            Json slot{{"name", p.name}};
            slot.update(slot_json(*p.slot));
            slot["help"] = p.help;
            slot["required"] = p.is_required;
            json["slots"].push_back(std::move(slot));
        } else {
            json["parameters"].push_back(parameter_json(p));
        }
    }
    return json;
}

bool has_pictures(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::is_directory(folder / "nodes" / "fields", ignored) &&
           std::filesystem::is_directory(folder / "reference", ignored);
}

}  // namespace

std::optional<std::filesystem::path> folder_of_pictures() {
    std::error_code error;
    std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    if (error) return std::nullopt;
    // PREFIX/bin has PREFIX/share beside it; build/release/tracer is in the source folder.
    for (int level = 0; level < 5 && folder.has_relative_path(); ++level, folder = folder.parent_path())
        for (const char* const beside : {"share/phasetree/scenes", "share/doc/phasetree/scenes", "scenes"})
            if (has_pictures(folder / beside)) return folder / beside;
    return std::nullopt;
}

std::string written_catalogue(const Vocabulary& vocabulary, const std::optional<std::filesystem::path>& pictures) {
    Json json;
    json["kinds"] = Json::array();
    for (const CatalogueKind& kind : vocabulary.kinds()) json["kinds"].push_back(kind_json(kind, pictures));
    json["measured_colors"] = Json::array();
    for (const MeasuredColour& colour : measured_colours()) {
        const glm::vec3& c = colour.reflectance;
        json["measured_colors"].push_back({{"name", colour.name}, {"group", colour.group}, {"color", {c.x, c.y, c.z}}});
    }
    json["placeholders"] = {{"phase", phase_placeholder},
                            {"other_phase", other_phase_placeholder},
                            {"file", file_placeholder},
                            {"object", object_placeholder}};
    return json.dump();
}

std::optional<std::filesystem::path> picture_file(const Vocabulary& vocabulary, const std::filesystem::path& folder,
                                                  std::string_view name) {
    for (const CatalogueKind& kind : vocabulary.kinds())
        if (const std::string picture = picture_of(kind); !picture.empty() && picture == name) return folder / picture;
    return std::nullopt;
}

}  // namespace phasetree::tracer::studio
