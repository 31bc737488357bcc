// Reads transforms from scene files.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "phasetree/io/document.hpp"
#include "scene/moving_transform.hpp"
#include "scene/shutter.hpp"
#include "scene/transform.hpp"

namespace phasetree::tracer {

/// Reads a transform at the document's time. It is written {"translate": {"by": […]}} or similar, as a list of such
/// maps that are applied in order, or as keys whose values are either. Throws SceneError.
Transform read_transform(const Document&, Value);

/// A transform at the opening of the shutter, and, if it may move, how it changes until the shutter closes.
struct ReadTransform {
    Transform at_opening{};
    std::optional<MovingTransform> moving{};
};
/// Reads a transform for the time in which the shutter is open. Throws SceneError.
ReadTransform read_transform(const Document&, Value, const Shutter&);
/// Reads a list of [x, y, z] and of lists of twelve numbers. Throws SceneError.
std::vector<Transform> read_transforms(const Document&, Value list);
/// Reads such transforms from the file that the value names (see object_kinds.hpp for the format). Throws SceneError at
/// the value.
std::vector<Transform> read_transforms_file(const Document&, Value named);

}  // namespace phasetree::tracer
