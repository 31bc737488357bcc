#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "phasetree/io/parameter_type.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// One parameter, as the reference and the schema show it.
struct ParameterPage {
    std::string name;
    std::string type;
    std::string unit;
    std::string description;
    std::string limits;         ///< "positive"; empty if there are none
    std::string default_value;  ///< as a file would say it, or a word such as "none"; empty if it is required
    bool optional = false;
    std::string schema;  ///< of the value: JSON text
};

/// A node or another kind of thing, with its parameters.
struct KindPage {
    std::string name;
    std::string section;   ///< of the paper; may be empty
    std::string equation;  ///< may be empty
    std::string summary;
    /// A picture of it is in this file with .jpg behind it, and what it shows in the one with .json; may be empty.
    std::string example;
    std::vector<ParameterPage> parameters;
    bool list_alone = false;  ///< its one required parameter is a list or a text, which may stand for the parameters
};

struct Chapter {
    std::string title;
    std::string text;
    std::vector<KindPage> pages;
};

/// The page of one parameter. The default value is left out if the parameter is required.
ParameterPage parameter_page(const Parameter&, const ValueType&, std::string default_value);

/// The page of a kind, from its list of parameters (io/kind.hpp).
template <class Kind>
KindPage page_of() {
    KindPage page;
    page.name = Kind::info.name;
    page.equation = Kind::info.equation;
    page.summary = Kind::info.summary;
    const Kind kind{};
    Kind::parameters([&](auto member, const auto& p) {
        const auto& value = kind.*member;
        using Type = ParameterType<std::remove_cvref_t<decltype(value)>, std::remove_cvref_t<decltype(p)>>;
        page.parameters.push_back(parameter_page(p, Type::describe(p), Type::written(value)));
    });
    return page;
}

template <class... Kinds>
std::vector<KindPage> pages_of(TypeList<Kinds...>) {
    return {page_of<Kinds>()...};
}

/// The nodes that trees are made of: fields, objects and warps.
std::vector<Chapter> node_chapters();

/// A reference of these chapters: every kind with its parameters, units, limits, defaults, equation and section of the
/// paper; as text for a terminal, and in Markdown, without a title.
std::string reference_text(std::span<const Chapter>);
std::string reference_markdown(std::span<const Chapter>);

/// JSON Schemas (draft 7) as JSON text: of a kind's parameters, of {"kind": {…}} for one of some kinds, and of what is
/// one of the definitions that a schema has.
std::string schema_of(const KindPage&);
std::string schema_of_one(std::span<const KindPage>);
std::string schema_reference(std::string_view definition);
/// Of what may be written in two ways.
std::string schema_of_either(const std::string& one, const std::string& other);

/// A whole schema with which an editor completes and checks scene files. `file` lists the keys of a file. Beside the
/// program's own definitions (a name, and a schema) there are "field" and "object", which nodes make, and
/// "keys".
std::string scene_schema(const KindPage& file, std::span<const std::pair<std::string, std::string>> definitions);

}  // namespace phasetree
