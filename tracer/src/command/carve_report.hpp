// Convex bounds of the whole object and of each phase, as `info --carve` prints them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "phasetree/carving/carve.hpp"
#include "phasetree/io/tree.hpp"

namespace phasetree::tracer {

struct CarvedPart {
    std::string name;  // the phase's name; empty for the whole object
    CarvedBounds bounds;
    double seconds = 0;
};

/// Carves the whole object and each of its phases. An object of one phase is carved only as a whole. Throws as carve()
/// does.
std::vector<CarvedPart> carve_parts(const SceneTree& tree, int max_planes);

void add_carved(nlohmann::ordered_json& json, const std::vector<CarvedPart>& parts);
void print_carved(const std::vector<CarvedPart>& parts);

}  // namespace phasetree::tracer
