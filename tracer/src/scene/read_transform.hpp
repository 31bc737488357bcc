// Transforms as scene files write them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/moving_transform.hpp"
#include "scene/shutter.hpp"
#include "scene/transform.hpp"

namespace phasetree::tracer {

/// {"translate": {"by": […]}} and the like, or a list of such, of which the first comes first, or keys of either; at
/// the document's time. Throws SceneError.
Transform read_transform(const Document&, Value);

/// A transform as it is when the shutter opens, and how it changes until it closes, if it may.
struct ReadTransform {
    Transform at_opening{};
    std::optional<MovingTransform> moving{};
};
/// The same while the shutter is open. Throws SceneError.
ReadTransform read_transform(const Document&, Value, const Shutter&);
/// A list of [x, y, z] and of lists of twelve numbers. Throws SceneError.
std::vector<Transform> read_transforms(const Document&, Value list);
/// The same from the file that the value names (object_kinds.hpp has its format). Throws SceneError at the value.
std::vector<Transform> read_transforms_file(const Document&, Value named);

}  // namespace phasetree::tracer
