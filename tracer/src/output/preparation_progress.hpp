// Progress of reading a scene: of the nodes that take longer than a second to prepare, such as large meshes.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

#include "output/late_progress.hpp"
#include "phasetree/model/preparation_watch.hpp"

namespace phasetree::tracer {

// Shows the progress of each node that this thread prepares while the object exists.
class PreparationProgress {
  public:
    explicit PreparationProgress(ProgressOutput output)
        : output_(std::move(output)),
          watch_({.cancelled = {}, .progress = [this](std::string_view, float share) { tell(share); }}) {}

  private:
    void tell(float share) {
        if (!progress_ || share <= 0) progress_.emplace(output_, "preparing a mesh");
        progress_->tell(static_cast<double>(share));
        if (share >= 1) progress_.reset();
    }

    ProgressOutput output_;
    std::optional<LateProgress> progress_;
    PreparationWatch watch_;
};

}  // namespace phasetree::tracer
