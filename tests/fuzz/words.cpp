#include "fuzz/words.hpp"

#include <set>

#include "phasetree/io/document.hpp"
#include "phasetree/io/reference.hpp"

namespace phasetree::fuzz {

namespace {

void collect(Value value, std::set<std::string>& found) {
    if (const auto properties = value.find("properties"); properties && properties->is_object())
        for (const Value property : *properties) found.emplace(property.key());
    for (const Value inner : value) collect(inner, found);
}

}  // namespace

std::vector<std::string> words() {
    std::set<std::string> found;
    const Document schema = Document::from_text(scene_json_schema());
    collect(schema.root(), found);
    return {found.begin(), found.end()};
}

}  // namespace phasetree::fuzz
