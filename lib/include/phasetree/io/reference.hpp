#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "phasetree/io/parameter_type.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// A parameter, as shown in the reference and the schema.
struct ParameterPage {
    std::string name;
    std::string type;
    std::string unit;
    std::string description;
    std::string limits;         ///< such as "positive"; empty if there are none
    std::string default_value;  ///< as written in a file, or a word such as "none"; empty if the parameter is required
    bool optional = false;
    std::string schema;  ///< of the value: JSON text
};

/// A node or another kind, with its parameters.
struct KindPage {
    std::string name;
    std::string section;   ///< NodeInfo::section: of the paper (Galin et al.); may be empty
    std::string equation;  ///< may be empty
    std::string summary;
    /// Path of the example without extension, relative to the reference; may be empty. The picture has the extension
    /// .jpg, its JSON .json.
    std::string example;
    std::string snippet;  ///< the example's JSON, to be shown on the page; may be empty
    std::vector<ParameterPage> parameters;
    /// Whether the only required parameter is a list or a text. Its value may then be written instead of the
    /// parameters.
    bool list_alone = false;
};

struct Chapter {
    std::string title;
    std::string text;
    std::vector<KindPage> pages;
};

/// Make the page of one parameter. The default value is omitted if the parameter is required.
ParameterPage parameter_page(const Parameter&, const ValueType&, std::string default_value);

/// Make the page of a kind from its list of parameters (io/kind.hpp).
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

/// The chapters about the nodes of trees: shapes, operators on fields, objects and warps.
std::vector<Chapter> node_chapters();

/// Format chapters as text for a terminal, with parameters, units, limits, defaults, equations and sections of the
/// paper (Galin et al.).
std::string reference_text(std::span<const Chapter>);

/// The title in lower case with hyphens, such as "operators-on-fields". It names the chapter's page and folder.
std::string file_stem(const Chapter&);

/// Format a chapter as a page of Markdown: a table of contents, then a section per kind with the same information as
/// the text, its picture and its snippet.
std::string reference_markdown(const Chapter&);

/// Format the list of the chapters' pages and their kinds as a Markdown table.
std::string reference_index(std::span<const Chapter>);

/// The JSON Schema (draft 7), as JSON text, of a kind's parameters.
std::string schema_of(const KindPage&);
/// The schema of {"kind": {…}} for any one of several kinds.
std::string schema_of_one(std::span<const KindPage>);
/// A reference to one of the schema's definitions.
std::string schema_reference(std::string_view definition);
/// The schema of a value that may be written in two ways.
std::string schema_of_either(const std::string& one, const std::string& other);

/// Make the complete schema from which editors complete and check scene files. `file` lists the keys of a file. Besides
/// the given definitions (name and schema), the schema defines "keys", and "field" and "object", which list the nodes.
std::string scene_schema(const KindPage& file, std::span<const std::pair<std::string, std::string>> definitions);

}  // namespace phasetree
