// The text of a document with its past and future: steps to undo and redo.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace phasetree::tracer::studio {

class History {
  public:
    /// The number of steps is not limited, but the oldest are dropped when all together need more than this.
    static constexpr std::size_t most_bytes = std::size_t{256} << 20;

    explicit History(std::string text, std::size_t most = most_bytes) : text_(std::move(text)), most_(most) {}

    const std::string& text() const { return text_; }

    /// Makes a new text the current one, which discards what could be redone. A step with the same `merge` key as the
    /// step before extends that step, unless something was undone in between. An unchanged text adds no step.
    void add(std::string text, std::string label, const std::optional<std::string>& merge = {});

    /// Return whether there was anything to undo or redo.
    bool undo();
    bool redo();

    /// The label of the next step to undo or to redo.
    std::optional<std::string> undo_label() const;
    std::optional<std::string> redo_label() const;

  private:
    // What a step replaces: only the part of the text that differs.
    struct Step {
        std::string label;
        std::optional<std::string> merge;
        std::size_t offset = 0;
        std::string before, after;

        std::size_t bytes() const {
            return sizeof(Step) + label.size() + (merge ? merge->size() : 0) + before.size() + after.size();
        }
    };

    static Step step_between(const std::string& before, const std::string& after);
    void drop_oldest();

    std::string text_;
    std::size_t most_;
    std::vector<Step> steps_;
    std::size_t done_ = 0;    // steps_ before this index are done; the others can be redone
    bool may_merge_ = false;  // whether the last step was added, and not undone or redone
    std::size_t bytes_ = 0;   // of all steps
};

}  // namespace phasetree::tracer::studio
