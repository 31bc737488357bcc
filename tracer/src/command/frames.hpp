// A film: frame after frame, each a picture of its own at its own time.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "command/render_options.hpp"
#include "phasetree/io/document.hpp"

namespace phasetree::tracer {

/// When a frame is, in seconds from the beginning of the film, as the scene's "frames_per_second" says. Throws
/// SceneError.
double seconds_of_frame(const Document& document, int frame);

/// A file's name for one frame: the last run of # becomes the frame's number, with zeros before it to as many digits;
/// nothing if the name has no #.
std::optional<std::string> name_of_frame(const std::string& name, int frame);

/// Renders the frames that --frames names, one after the other, by `render`, which returns an exit code. Ends with the
/// first that is not 0 and returns that. An exception passes on, and it is said before in which frame it was thrown.
/// Throws OutputError for options that do not go with frames.
int render_frames(const RenderOptions& options, const std::function<int(const RenderOptions&)>& render);

}  // namespace phasetree::tracer
