// The list of all glTF extensions that this program knows, and what it does with each.
//
// Reference: https://github.com/KhronosGroup/glTF/tree/main/extensions
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

/// Throws GltfError, which names the extension and a remedy, if the file requires an extension without which the
/// picture would be wrong. Without `has_materials`, extensions of materials and images do not count. With `has_phases`,
/// clear materials become phases, so their extensions are read.
void check_required_extensions(const Document&, bool has_materials, bool has_phases = false);

/// What a material loses because an extension is not read, as a predicate such as "loses sheen of cloth". Empty if it
/// loses nothing, or if messages must not quote the name.
std::string loss_without(std::string_view name);

/// One sentence that lists the extensions that are not read and may change the picture, and what is missing; empty if
/// there are none. `used` are names from the file, which is not trusted: only what looks like a name is quoted.
/// `has_materials` is as above.
std::string sentence_about_unread(const std::set<std::string>& used, bool has_materials);

}  // namespace phasetree::tracer::gltf
