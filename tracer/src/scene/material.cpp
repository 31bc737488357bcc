#include <fmt/format.h>

#include "phasetree/io/read_kind.hpp"
#include "scene/material_kinds.hpp"
#include "scene/read_parts.hpp"
#include "shading/metals.hpp"

namespace phasetree::tracer {

std::vector<std::string_view> names_of_metals() {
    std::vector<std::string_view> names;
    for (const Metal& metal : metals()) names.push_back(metal.name);
    names.push_back("aluminum");
    return names;
}

Conductor ConductorParameters::made() const {
    if (metal && (eta || k))
        throw ParameterError("metal", "\"metal\" names \"eta\" and \"k\"; give either the one or the others",
                             ParameterError::Place::key);
    if (metal) {
        const Metal found = find_metal(*metal).value();
        return {found.eta, found.k, roughness, film()};
    }
    if (!eta) throw ParameterError("eta", "is missing");
    if (!k) throw ParameterError("k", "is missing");
    return {*eta, *k, roughness, film()};
}

Material read_material(const Document& document, Value value) {
    Material material;
    with_kind(MaterialKinds(), document, value, "a material", [&]<class Kind>(Value member) {
        material = read_kind<Kind>(document, member, fmt::format("the {} material", Kind::info.name),
                                   [](const Kind& kind) { return kind.made(); });
    });
    return material;
}

}  // namespace phasetree::tracer
