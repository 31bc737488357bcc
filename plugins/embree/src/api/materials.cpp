// The phases' materials, which the library passes on as written in the scene.

#include <algorithm>

#include "api/tree_data.hpp"

namespace phasetree::embree::api {

// The text must be valid JSON with comments, so a slash outside a string begins a comment.
std::string json_of(const Document& document, const Value& value) {
    const std::string& text = document.text();
    const std::size_t end = end_of(text, value);
    std::string json;
    bool is_in_string = false;
    for (std::size_t at = value.offset(); at < end; ++at) {
        const char c = text[at];
        if (is_in_string && c == '\\') {
            json += c;
            json += text[++at];
            continue;
        }
        if (c == '"') is_in_string = !is_in_string;
        if (is_in_string || c != '/') {
            json += c;
        } else if (text[at + 1] == '/') {
            at = text.find_first_of("\r\n", at) - 1;
        } else {
            at = text.find("*/", at + 2) + 1;
        }
    }
    return json;
}

}  // namespace phasetree::embree::api

using namespace phasetree::embree::api;

PhasetreeError phasetreeGetTreePhaseMaterial(PhasetreeTree tree, unsigned int phase, const char** json) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        require(json, "json");
        if (phase >= data.materials.size())
            throw invalid("phase {} does not exist; the tree has {}", phase, data.materials.size());
        *json = data.materials[phase] ? data.materials[phase]->c_str() : nullptr;
    });
}
