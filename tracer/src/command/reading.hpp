// Work before the first sample that may take long, and that leaves nothing behind: reading the scene, and preparing it.
// It shows how far it is if it takes longer than a second, and a signal ends the command at once.
#pragma once

#include <cstdint>
#include <string_view>

#include "command/scene_file.hpp"
#include "output/interrupt.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

// A signal ends the command while this lives, and an InterruptGuard does. `what` goes on "interrupted while", and
// `can_resume` says whether there is a checkpoint to go on from.
EndingAtOnce ending_at_once(std::string_view what, bool can_resume);

// The same as read_document and load_scene, which throw the same.
Document read_document_showing(const SceneFile& file, bool quiet);
Scene load_scene_showing(const Document& document, bool quiet);
// As fingerprint(), for which all files are read once more.
std::uint64_t fingerprint_showing(const Document& document, bool quiet);

}  // namespace phasetree::tracer
