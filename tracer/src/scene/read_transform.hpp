// Transforms as scene files write them.
#pragma once

#include <filesystem>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/transform.hpp"

namespace phasetree::tracer {

/// {"translate": {"by": […]}} and the like, or a list of such, of which the first comes first. Throws SceneError.
Transform read_transform(const Document&, Value);
/// A list of [x, y, z] and of lists of twelve numbers. Throws SceneError.
std::vector<Transform> read_transforms(const Document&, Value list);
/// The same from the file that the value names (object_kinds.hpp has its format). Throws SceneError at the value.
std::vector<Transform> read_transforms_file(const Document&, Value named);

}  // namespace phasetree::tracer
