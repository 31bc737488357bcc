// Which solid keeps the space where several overlap.
//
// For two solids that overlap, the first of these rules that applies decides:
//   1. Priority: the higher `phasetree_priority` in the extras of the node, else of the material; 0 without one.
//   2. Containment: a solid within the other is kept, as ice in water, a bubble in glass, and liquid in a solid block.
//   3. Matter: solids over gases, gases over liquids. So glass keeps its wall where liquid reaches into it, ice keeps
//      its part of the water, and a bubble at the surface dents the water but not the glass.
//   4. The earlier in the file.
// Rules of several pairs may contradict each other; then the weaker ones give way.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf_import/contacts.hpp"
#include "gltf_import/solids.hpp"

namespace phasetree::tracer::gltf_import {

/// In the order of rule 3.
enum class Matter { solid, gas, liquid };
std::string_view name_of(Matter);

/// What an object is made of. An index below 1.1 is a gas. Otherwise the object's name decides, else the material's, by
/// the last word that is known, without what follows "of", "in" or "with": "glass of water" is solid, "water" liquid.
/// If neither name has a known word, an index from 1.32 to 1.4 is a liquid and any other a solid; ice has 1.31.
Matter matter_of(std::string_view object, std::string_view material, float ior);

/// The matter of that name; nullopt if there is none.
std::optional<Matter> matter_named(std::string_view name);

struct Decision {
    std::size_t winner = 0, loser = 0;  ///< numbers of solids
    std::string reason{};               ///< such as "solid over liquid"
    int rule = 0;                       ///< 1 to 4
};

struct Precedence {
    std::vector<std::size_t> order;     ///< numbers of all solids; earlier ones win
    std::vector<Decision> decisions;    ///< for each contact with an overlap, in that order
    std::vector<std::string> warnings;  ///< sentences
};

/// Applies the rules. `matter` has an entry per solid.
Precedence precedence_of(const std::vector<Solid>& solids, const std::vector<Matter>& matter,
                         const std::vector<Contact>& contacts);

}  // namespace phasetree::tracer::gltf_import
