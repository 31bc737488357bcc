// What scene files consist of, as data: the kinds of nodes, materials, lights and so on with their parameters. Derived
// from the lists of parameters that the readers use (scene/reference.hpp), so nothing can be missing here.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/parameter_relations.hpp"

namespace phasetree::tracer::studio {

/// What a slot accepts. A slot is a parameter that holds other nodes, such as the operands (fields) of the node
/// `union`.
struct SlotType {
    std::string type;      ///< "field", "object", "light", …
    bool is_list = false;  ///< whether it takes a list of them
};

/// A parameter of a kind of node, material, light, …, such as `radius` of `sphere`.
struct KindParameter {
    std::string name;
    /// How the studio's page (a browser tab) edits it: "length", "angle", "number", "integer", "vector", "direction",
    /// "point", "color", "spectrum", "phase", "phases", "boolean", "choice", "file", "curve", "text" or "json"; "slot"
    /// for parameters that are made of other kinds.
    std::string control;
    std::string unit, help;
    std::string type;           ///< in words, as in the reference
    std::string default_value;  ///< JSON text, or empty
    std::optional<double> low, high;
    bool low_is_open = false, high_is_open = false;
    std::vector<std::string> choices;
    bool is_required = false;
    bool may_be_keyed = false;  ///< whether it may change with time
    /// The type of the values that the parameter holds (control "slot"), or that may replace its plain value.
    std::optional<SlotType> slot;
};

/// A kind: one member of a type, such as `sphere` of the type "field".
struct CatalogueKind {
    std::string name;     ///< its key in scene files
    std::string chapter;  ///< of the reference, such as "operators-on-fields"
    std::string type;     ///< "field", "object", …
    std::string summary, equation;
    std::string section;  ///< of the paper; may be empty
    std::string picture;  ///< its path relative to scenes, without extension; may be empty
    /// Whether values are written {"name": {parameters}}. Otherwise they are written {parameters}.
    bool is_written_with_name = true;
    /// Whether the value of the only required parameter, a list or a string, may replace the whole parameter object:
    /// {"union": […]} for {"union": {"of": […]}}.
    bool has_short_form = false;
    bool for_meshes_only = false;  ///< whether it is a material that phases cannot have
    std::vector<KindParameter> parameters;
    ParameterRelations relations;

    /// The parameter with this key, in British or American spelling (colour, color); null if there is none.
    const KindParameter* parameter(std::string_view key) const;
    /// The parameter whose bare value may replace the parameter object; null if the kind has no such short form.
    const KindParameter* lone_parameter() const;
};

class Vocabulary {
  public:
    Vocabulary();

    const std::vector<CatalogueKind>& kinds() const { return kinds_; }
    /// The kind of a type with this key; null if there is none.
    const CatalogueKind* find(std::string_view type, std::string_view name) const;
    /// The only kind of a type, such as "render", if the type has just one and its values are written without the
    /// kind's name; otherwise null.
    const CatalogueKind* only(std::string_view type) const;

  private:
    std::vector<CatalogueKind> kinds_;
    std::map<std::string, std::map<std::string, std::size_t, std::less<>>, std::less<>> by_type_;
};

}  // namespace phasetree::tracer::studio
