#pragma once

#include "phasetree/model/preparation_watch.hpp"

namespace phasetree {

/// Throws PreparationCancelled if this thread's PreparationWatch cancels. Call it during long work outside of nodes.
inline void poll_preparation() {
    const PreparationWatch::Callbacks* const watch = PreparationWatch::current();
    if (watch && watch->cancelled && watch->cancelled()) throw PreparationCancelled();
}

}  // namespace phasetree
