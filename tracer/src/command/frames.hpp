// Animations: a sequence of frames, each rendered as a picture of its own at its own time.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "command/render_options.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// The time of a frame in seconds from the beginning of the animation, by the scene's "frames_per_second". Throws
/// SceneError.
double seconds_of_frame(const Document& document, int frame);

/// The file name of one frame: the last run of # is replaced by the frame number, zero-padded to the same number of
/// digits. Returns nullopt if the name has no #.
std::optional<std::string> name_of_frame(const std::string& name, int frame);

/// Calls `render`, which returns an exit code, for each frame of --frames in order. Stops at the first exit code other
/// than 0 and returns it. If a frame throws, reports which one and rethrows. Throws UsageError for options that cannot
/// be combined with frames.
int render_frames(const RenderOptions& options, const std::function<int(const RenderOptions&)>& render);

}  // namespace phasetree::tracer
