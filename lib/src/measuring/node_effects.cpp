#include "phasetree/measuring/node_effects.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <unordered_map>
#include <unordered_set>

#include "measuring/same_labels.hpp"
#include "phasetree/math/float_mode.hpp"
#include "tree/node.hpp"

namespace phasetree {

std::string_view name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::proved:
            return "proved";
        case Verdict::refuted:
            return "refuted";
        case Verdict::undecided:
            return "undecided";
    }
    return "";
}

const void* address_of(const AnyNode& node) {
    return std::visit([](const auto& handle) -> const void* { return handle.node(); }, node);
}

std::string_view name_of(const AnyNode& node) {
    return std::visit(
        [](const auto& handle) {
            return std::visit([](const auto& n) -> std::string_view { return n.info.name; }, handle.node()->node);
        },
        node);
}

namespace measuring {

namespace {

template <class T>
constexpr bool is_node = std::is_same_v<T, Field> || std::is_same_v<T, Phased>;
template <class T>
constexpr bool is_list = std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, std::vector<Phased>>;

// A node that is left out, and the node that its parent becomes.
struct Removal {
    NodeEffect effect;
    AnyNode parent_without;
    bool is_identity = false;  // the node is a map of space that moves no point
};

// Whether a node maps space without moving any point, as a translation by 0 does.
template <class Node>
bool is_identity(const Node& node) {
    if constexpr (requires { node.warp.map().affine(); }) {
        const auto map = node.warp.map().affine();
        return !map.moves_before() && !map.moves_after() && !map.turns();
    } else {
        return false;
    }
}

// Finds the nodes that can be left out, parents first.
class Removals {
  public:
    explicit Removals(const Phased& object) { add(object); }
    std::vector<Removal> take() { return std::move(found_); }

  private:
    template <class Handle>
    void add(const Handle& handle) {
        if (!seen_.insert(handle.node()).second) return;
        std::visit([&](const auto& node) { add_of(handle, node); }, handle.node()->node);
        std::visit([&](const auto& node) { for_each_child(node, [&](const auto& child) { add(child); }); },
                   handle.node()->node);
    }
    template <class Handle, class Node>
    void add_of(const Handle& handle, const Node& node) {
        std::size_t children = 0;
        for_each_child(node, [&](const auto&) { ++children; });
        std::size_t parameter = 0;
        for_each_parameter(node, [&](const auto& value, const Parameter&) {
            using T = std::remove_cvref_t<decltype(value)>;
            const std::size_t number = parameter++;
            if constexpr (is_list<T>) {
                for (std::size_t i = 0; value.size() > 1 && i < value.size(); ++i)
                    add_item(handle, node, number, i, value[i]);
                if constexpr (std::is_same_v<typename T::value_type, Handle>)
                    if (value.size() == 1) add_replaced(handle, node, children, value.front());
            } else if constexpr (std::is_same_v<T, Handle>) {
                if (value) add_replaced(handle, node, children, value);
            }
        });
    }
    // Removes item i of the list that is this parameter of the node.
    template <class Handle, class Node>
    void add_item(const Handle& handle, Node copy, std::size_t number, std::size_t i, const AnyNode& item) {
        std::size_t parameter = 0;
        for_each_parameter(copy, [&](auto& value, const Parameter&) {
            if constexpr (is_list<std::remove_cvref_t<decltype(value)>>)
                if (parameter == number) value.erase(value.begin() + static_cast<std::ptrdiff_t>(i));
            ++parameter;
        });
        try {
            found_.push_back({NodeEffect{item, handle}, Handle(std::move(copy))});
        } catch (const ModelError&) {
            // Rejected: the node has a second list that must have as many items.
        }
    }
    // Replaces the node by one of its operands.
    template <class Handle, class Node>
    void add_replaced(const Handle& handle, const Node& node, std::size_t children, const Handle& kept) {
        AnyNode left_out = handle;
        if (children == 2)
            for_each_child(node, [&](const auto& child) {
                if (address_of(child) != kept.node()) left_out = child;
            });
        NodeEffect effect{left_out, handle};
        effect.kept = kept;
        found_.push_back({effect, kept, is_identity(node)});
    }

    std::unordered_set<const void*> seen_;
    std::vector<Removal> found_;
};

// Makes copies of a tree in which one node is replaced. Only its ancestors are recreated.
class Replacement {
  public:
    Replacement(const AnyNode& from, const AnyNode& to) { set(address_of(from), to); }

    template <class Handle>
    Handle operator()(const Handle& handle) {
        auto& known = known_by(handle);
        if (const auto found = known.find(handle.node()); found != known.end()) return found->second;
        Handle result = std::visit(
            [&](const auto& node) {
                auto copy = node;
                bool is_changed = false;
                const auto change = [&](auto& child) {
                    if (!child) return;
                    auto other = (*this)(child);
                    is_changed = is_changed || !(other == child);
                    child = std::move(other);
                };
                for_each_parameter(copy, [&](auto& value, const Parameter&) {
                    using T = std::remove_cvref_t<decltype(value)>;
                    if constexpr (is_node<T>) {
                        change(value);
                    } else if constexpr (is_list<T>) {
                        for (auto& child : value) change(child);
                    }
                });
                return is_changed ? Handle(std::move(copy)) : handle;
            },
            handle.node()->node);
        known.emplace(handle.node(), result);
        return result;
    }

  private:
    auto& known_by(const Field&) { return fields_; }
    auto& known_by(const Phased&) { return objects_; }
    void set(const void* address, const AnyNode& to) {
        std::visit([&](const auto& handle) { known_by(handle).emplace(address, handle); }, to);
    }
    std::unordered_map<const void*, Field> fields_;
    std::unordered_map<const void*, Phased> objects_;
};

// The removals that are reached without passing through dead nodes.
class Reached {
  public:
    explicit Reached(const std::vector<Removal>& removals) {
        for (const Removal& r : removals) by_parent_[address_of(r.effect.parent)].push_back(&r);
    }
    std::vector<NodeEffect> from(const Phased& object) {
        add(object);
        return std::move(effects_);
    }

  private:
    template <class Handle>
    void add(const Handle& handle) {
        if (!seen_.insert(handle.node()).second) return;
        std::unordered_set<const void*> dead;
        const AnyNode* only = nullptr;
        for (const Removal* r : by_parent_[handle.node()]) {
            const NodeEffect& e = r->effect;
            // If each of two operands is dead only while the other stays, report just one of them.
            if (only && e.kept && e.is_dead == Verdict::proved) continue;
            effects_.push_back(e);
            if (e.is_dead != Verdict::proved) continue;
            if (e.kept)
                only = &*e.kept;
            else
                dead.insert(address_of(e.node));
        }
        std::visit(
            [&](const auto& node) {
                for_each_child(node, [&](const auto& child) {
                    const bool is_left_out = dead.contains(child.node()) || (only && address_of(*only) != child.node());
                    if (!is_left_out) add(child);
                });
            },
            handle.node()->node);
    }

    std::unordered_map<const void*, std::vector<const Removal*>> by_parent_;
    std::unordered_set<const void*> seen_;
    std::vector<NodeEffect> effects_;
};

}  // namespace

}  // namespace measuring

std::vector<NodeEffect> node_effects(const Phased& object, const NodeEffectsOptions& options) {
    using Clock = std::chrono::steady_clock;
    if (!(options.seconds > 0))
        throw ModelError(fmt::format("the time must be a positive number of seconds, but is {}", options.seconds));
    const Clock::time_point start = Clock::now();
    const TraceableObject traceable = prepare_to_trace(object);
    (void)record(object);  // throws if the object is too large
    std::vector<measuring::Removal> removals = measuring::Removals(object).take();
    std::atomic<bool> is_stopped{false};
    std::atomic<std::size_t> done{0};
    const std::function<bool()> stopped = [&] {
        if (!is_stopped && ((options.cancelled && options.cancelled()) ||
                            std::chrono::duration<double>(Clock::now() - start).count() > options.seconds))
            is_stopped = true;
        return is_stopped.load();
    };
    tbb::parallel_for(std::size_t{0}, removals.size(), [&](std::size_t i) {
        if (stopped()) return;
        const FlushSubnormals flush;
        measuring::Removal& r = removals[i];
        try {
            const Phased without = measuring::Replacement(r.effect.parent, r.parent_without)(object);
            const measuring::SameLabels same =
                r.is_identity ? measuring::SameLabels{Verdict::proved, {}}
                              : measuring::same_labels(object, without, traceable, options.max_boxes, stopped);
            r.effect.without = without;
            r.effect.is_dead = same.verdict;
            r.effect.change = same.change;
        } catch (const ModelError&) {
            // An ancestor is invalid without the node, so its effect stays undecided.
        }
        if (options.progress) options.progress(static_cast<float>(++done) / static_cast<float>(removals.size()));
    });
    return measuring::Reached(removals).from(object);
}

}  // namespace phasetree
