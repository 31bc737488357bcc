#include "studio/history.hpp"

#include <algorithm>
#include <utility>

namespace phasetree::tracer::studio {

History::Step History::step_between(const std::string& before, const std::string& after) {
    const std::size_t shorter = std::min(before.size(), after.size());
    std::size_t same = 0;
    while (same < shorter && before[same] == after[same]) ++same;
    std::size_t end = 0;  // bytes that are the same at the end
    while (end < shorter - same && before[before.size() - 1 - end] == after[after.size() - 1 - end]) ++end;
    Step step;
    step.offset = same;
    step.before = before.substr(same, before.size() - same - end);
    step.after = after.substr(same, after.size() - same - end);
    return step;
}

void History::add(std::string text, std::string label, const std::optional<std::string>& merge) {
    if (text == text_) return;
    for (std::size_t i = done_; i < steps_.size(); ++i) bytes_ -= steps_[i].bytes();
    steps_.resize(done_);
    std::string before = text_;
    if (merge && may_merge_ && done_ > 0 && steps_.back().merge == merge) {
        const Step& last = steps_.back();
        before.replace(last.offset, last.after.size(), last.before);
        bytes_ -= last.bytes();
        steps_.pop_back();
        --done_;
    }
    may_merge_ = before != text;
    if (!may_merge_) {  // a drag that ended where it began
        text_ = std::move(text);
        return;
    }
    Step step = step_between(before, text);
    step.label = std::move(label);
    step.merge = merge;
    text_ = std::move(text);
    bytes_ += step.bytes();
    steps_.push_back(std::move(step));
    done_ = steps_.size();
    drop_oldest();
}

void History::drop_oldest() {
    std::size_t dropped = 0;
    // The last step stays, however large it is.
    while (bytes_ > most_ && dropped + 1 < done_) bytes_ -= steps_[dropped++].bytes();
    steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(dropped));
    done_ -= dropped;
}

bool History::undo() {
    if (done_ == 0) return false;
    const Step& step = steps_[--done_];
    text_.replace(step.offset, step.after.size(), step.before);
    may_merge_ = false;
    return true;
}

bool History::redo() {
    if (done_ == steps_.size()) return false;
    const Step& step = steps_[done_++];
    text_.replace(step.offset, step.before.size(), step.after);
    may_merge_ = false;
    return true;
}

std::optional<std::string> History::undo_label() const {
    return done_ > 0 ? std::optional(steps_[done_ - 1].label) : std::nullopt;
}

std::optional<std::string> History::redo_label() const {
    return done_ < steps_.size() ? std::optional(steps_[done_].label) : std::nullopt;
}

}  // namespace phasetree::tracer::studio
