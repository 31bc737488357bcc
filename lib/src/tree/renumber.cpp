#include "phasetree/model/renumber.hpp"

#include <fmt/format.h>
#include <unordered_map>

#include "tree/node.hpp"

namespace phasetree {

namespace {

// Recreates each node whose parameters change. Unchanged subtrees, such as pure fields, keep their handles.
class Renumbering {
  public:
    Renumbering(std::span<const Phase> numbers, const NodeCopied& copied) : numbers_(numbers), copied_(copied) {
        PhaseSet used;
        for (std::size_t i = 1; i < numbers.size(); ++i) {
            const Phase to = numbers[i];
            if (to == vacuum || to.index >= Phase::capacity)
                throw ModelError(fmt::format("phase {} cannot become phase {}", i, to.index));
            if (used.contains(to)) throw ModelError(fmt::format("two phases would become phase {}", to.index));
            used = used | PhaseSet::of(to);
        }
    }

    template <class Handle>
    Handle operator()(const Handle& handle) {
        if (!handle) return handle;
        auto& known = made<Handle>();
        if (const auto found = known.find(handle.node()); found != known.end()) return found->second;
        Handle result = std::visit(
            [&](const auto& node) {
                auto copy = node;
                bool is_changed = false;
                for_each_parameter(copy,
                                   [&](auto& value, const Parameter&) { is_changed = change(value) || is_changed; });
                if (!is_changed) return handle;
                Handle made(std::move(copy));
                if (copied_) copied_(handle.node(), made);
                return made;
            },
            handle.node()->node);
        known.emplace(handle.node(), result);
        return result;
    }

  private:
    template <class Handle>
    auto& made() {
        if constexpr (std::is_same_v<Handle, Field>)
            return fields_;
        else
            return objects_;
    }

    Phase number(Phase p) const {
        if (p == vacuum) return p;
        if (p.index >= numbers_.size()) throw ModelError(fmt::format("phase {} has no new number", p.index));
        return numbers_[p.index];
    }

    // Applies the new number. Returns whether the value changed.
    bool change(Phase& p) const {
        const Phase before = p;
        p = number(p);
        return p != before;
    }
    bool change(PhaseSet& set) const {
        const PhaseSet before = set;
        set = {};
        for_each_phase(before.bits,
                       [&](int i) { set = set | PhaseSet::of(number(Phase{static_cast<std::uint8_t>(i)})); });
        return set != before;
    }
    bool change(Field& child) { return change_child(child); }
    bool change(Phased& child) { return change_child(child); }
    template <class Handle>
    bool change_child(Handle& child) {
        const Handle before = child;
        child = (*this)(child);
        return child != before;
    }
    template <class T>
    bool change(std::vector<T>& list) {
        bool is_changed = false;
        for (T& item : list) is_changed = change(item) || is_changed;
        return is_changed;
    }
    template <class Other>
    bool change(const Other&) const {
        return false;
    }

    std::span<const Phase> numbers_;
    const NodeCopied& copied_;
    std::unordered_map<const void*, Field> fields_;
    std::unordered_map<const void*, Phased> objects_;
};

}  // namespace

Phased renumbered(const Phased& object, std::span<const Phase> numbers, const NodeCopied& copied) {
    return Renumbering(numbers, copied)(object);
}

Field renumbered(const Field& field, std::span<const Phase> numbers, const NodeCopied& copied) {
    return Renumbering(numbers, copied)(field);
}

}  // namespace phasetree
