#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "phasetree/io/read_kind.hpp"
#include "scene/material_kinds.hpp"
#include "scene/read_parts.hpp"
#include "shading/metals.hpp"

namespace phasetree::tracer {

Clear ClearParameters::made() const {
    AbsorbingMedium medium{absorption.value_or(glm::vec3(0.0f))};
    if (color) {
        if (absorption)
            throw ParameterError("color", "\"color\" and \"absorption\" say the same; give one of them",
                                 ParameterError::Place::key);
        for (int i = 0; i < 3; ++i) medium.absorption[i] = std::max(0.0f, -std::log((*color)[i]) / color_distance);
    }
    Clear clear;
    clear.ior = ior;
    clear.interior = medium;
    clear.roughness = roughness;
    clear.film = film();
    return clear;
}

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
