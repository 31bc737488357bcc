// Reading and preparing a scene, with progress. This may take long, so progress is shown after a second. There is
// nothing to save yet, so a signal ends the command at once.
#pragma once

#include <cstdint>
#include <string_view>

#include "command/scene_file.hpp"
#include "output/interrupt.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// While both this object and an InterruptGuard exist, a signal ends the command at once. `what` completes the message
// "interrupted while", and `can_resume` says whether a checkpoint exists.
EndingAtOnce ending_at_once(std::string_view what, bool can_resume);
// For commands that only print: an interruption while the scene is read says that nothing is known yet.
EndingAtOnce ending_before_results();

// As read_document and load_scene, with progress. They throw the same exceptions.
Document read_document_showing(const SceneFile& file, bool quiet);
Scene load_scene_showing(const Document& document, bool quiet);
// As fingerprint(), with progress. Reads all files again.
std::uint64_t fingerprint_showing(const Document& document, bool quiet);

}  // namespace phasetree::tracer
