#include "glsl/loops.hpp"

#include <algorithm>

#include "glsl/readings.hpp"
#include "phasetree_support/mixed_hash.hpp"

namespace phasetree::glsl {

namespace {

constexpr std::uint32_t fewest_iterations = 3;
// A loop that saves fewer steps than this is harder to read than the unrolled steps.
constexpr std::uint32_t fewest_saved = 32, fewest_saved_by_prefix = 256;
// Limits of the search: the length of an iteration, in items, the total number of comparisons, and the total number of
// steps in candidate loops.
constexpr std::size_t longest_iteration = 2048, most_comparisons = std::size_t{1} << 28,
                      most_steps_tried = std::size_t{1} << 25;

// An item that is not yet in a loop, with a hash of its form: its operations without its operands.
struct Candidate {
    NestItem item;
    std::uint64_t form;
};

class LoopSearch {
  public:
    explicit LoopSearch(const Trace& trace) : trace_(trace) {
        for (std::uint32_t i = 0; i < trace.steps.size(); ++i) {
            const TraceStep& s = trace.steps[i];
            const std::uint64_t form =
                support::mixed(static_cast<std::uint64_t>(s.op) << 8 | static_cast<std::uint64_t>(s.function),
                               static_cast<std::uint64_t>(s.table) << 4 | s.operands);
            list_.push_back({{i, 1, 1, {}}, form});
        }
    }

    std::vector<NestItem> run() {
        std::size_t comparisons = 0;
        for (std::size_t length = 1; length <= longest_iteration && fewest_iterations * length <= list_.size();
             ++length) {
            comparisons += list_.size();
            if (comparisons > most_comparisons) break;
            // Start again: loops around those just found may have fewer items per iteration.
            if (find_of_length(length)) length = 0;
        }
        std::vector<NestItem> items;
        for (Candidate& c : list_) items.push_back(std::move(c.item));
        return items;
    }

  private:
    // Finds loops whose iterations consist of this many items. Returns whether there are any.
    bool find_of_length(std::size_t length) {
        // For each item, the number of consecutive items from it on that equal the item one iteration later.
        std::vector<std::uint32_t> equal(list_.size(), 0);
        bool has_any = false;
        for (std::size_t i = list_.size() - length; i-- > 0;) {
            equal[i] = list_[i].form == list_[i + length].form ? equal[i + 1] + 1 : 0;
            has_any = has_any || equal[i] + length >= fewest_iterations * length;
        }
        if (!has_any) return false;
        const std::size_t before = list_.size();
        std::vector<Candidate> result;
        std::size_t failures = 0;
        for (std::size_t i = 0; i < list_.size();) {
            const auto iterations = static_cast<std::uint32_t>(equal[i] / length + 1);
            // A repeating stretch may begin less than one iteration before the loop does.
            if (iterations >= fewest_iterations && failures < length) {
                if (auto loop = longest_loop_at(i, length, iterations)) {
                    i += loop->item.count * length;
                    result.push_back(std::move(*loop));
                    failures = 0;
                    continue;
                }
                ++failures;
            }
            if (equal[i] == 0) failures = 0;
            result.push_back(std::move(list_[i++]));
        }
        list_ = std::move(result);
        return list_.size() < before;
    }

    // If not all iterations form a loop, the first ones may, as in two layers of a network with the same width. This is
    // tried only if it saves a lot. Otherwise, it could break up what forms a loop in another way.
    std::optional<Candidate> longest_loop_at(std::size_t first, std::size_t length, std::uint32_t iterations) {
        auto found = loop_at(first, length, iterations);
        if (found) return found;
        const std::uint32_t period = list_[first + length].item.offset - list_[first].item.offset;
        std::uint32_t holds = std::max(fewest_iterations, fewest_saved_by_prefix / period + 1) - 1, fails = iterations;
        while (fails > holds + 1) {
            const std::uint32_t middle = holds + (fails - holds) / 2;
            auto prefix = loop_at(first, length, middle);
            if (prefix) found = std::move(prefix);
            (found && found->item.count == middle ? holds : fails) = middle;
        }
        return found;
    }

    std::optional<Candidate> loop_at(std::size_t first, std::size_t length, std::uint32_t iterations) {
        const std::uint32_t start = list_[first].item.offset;
        NestItem loop{start, list_[first + length].item.offset - start, iterations, {}};
        if ((iterations - 1) * loop.period < fewest_saved) return std::nullopt;
        std::uint64_t form = iterations;
        for (std::size_t i = first; i < first + length; ++i) {
            loop.body.push_back(list_[i].item);
            loop.body.back().offset -= start;
            form = support::mixed(form, list_[i].form);
        }
        steps_tried_ += loop.span();
        if (steps_tried_ > most_steps_tried || !is_loop(trace_, loop)) return std::nullopt;
        return Candidate{std::move(loop), form};
    }

    const Trace& trace_;
    std::vector<Candidate> list_;
    std::size_t steps_tried_ = 0;
};

}  // namespace

std::vector<NestItem> find_loops(const Trace& trace) {
    return LoopSearch(trace).run();
}

}  // namespace phasetree::glsl
