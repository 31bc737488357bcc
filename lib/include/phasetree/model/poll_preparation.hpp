#pragma once

#include "phasetree/model/preparation_watch.hpp"

namespace phasetree {

/// Throws PreparationCancelled if this thread's PreparationWatch cancels. Call it regularly in slow code of your own
/// that runs under a PreparationWatch and creates no nodes.
inline void poll_preparation() {
    const PreparationWatch::Callbacks* const watch = PreparationWatch::current();
    if (watch && watch->cancelled && watch->cancelled()) throw PreparationCancelled();
}

}  // namespace phasetree
