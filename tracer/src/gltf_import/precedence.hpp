// Which clear object keeps the space where several overlap.
//
// For two objects that overlap, the first of these rules that applies decides:
//   1. Priority: the higher `phasetree_priority` in the extras of the node, else of the material; 0 without one.
//   2. Containment: an object inside the other is kept, as ice in water, a bubble in glass, or liquid in a block of
//      glass.
//   3. Matter: solids over gases, gases over liquids. So glass keeps its wall where liquid reaches into it, ice keeps
//      its part of the water, and a bubble at the surface dents the water but not the glass.
//   4. The earlier in the file.
// The decisions for several pairs may form a cycle (A over B, B over C, C over A). Decisions by earlier rules are then
// kept, and those by later rules are reversed.
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

/// What an object is made of. A refractive index below 1.1 means gas. Otherwise, the object's name is searched for the
/// words listed in precedence.cpp and, if it has none of them, the material's name. The last word found decides, but
/// once one has been found, the rest of the name after "of", "in" or "with" is ignored: "glass of water" is solid,
/// "water" liquid. If neither name has such a word, an index from 1.32 to 1.4 means liquid, and any other index means
/// solid (ice has 1.31).
Matter matter_of(std::string_view object, std::string_view material, float ior);

/// The matter of that name; nullopt if there is none.
std::optional<Matter> matter_named(std::string_view name);

struct Decision {
    std::size_t winner = 0, loser = 0;  ///< indices of objects
    std::string reason{};               ///< such as "solid over liquid"
    int rule = 0;                       ///< 1 to 4
};

struct Precedence {
    std::vector<std::size_t> order;     ///< indices of all objects; earlier ones win
    std::vector<Decision> decisions;    ///< one per contact that overlaps, in the order of the contacts
    std::vector<std::string> warnings;  ///< sentences
};

/// Applies the rules. `matter` has an entry per object in `solids`.
Precedence precedence_of(const std::vector<Solid>& solids, const std::vector<Matter>& matter,
                         const std::vector<Contact>& contacts);

}  // namespace phasetree::tracer::gltf_import
