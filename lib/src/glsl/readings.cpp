#include "glsl/readings.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

namespace phasetree::glsl {

namespace {

// The maximum size of an array, as a multiple of the number of elements that are read.
constexpr std::size_t largest_spare = 8;

bool same(const Operand& a, const Operand& b) {
    return a.value == b.value && std::bit_cast<std::uint32_t>(a.constant) == std::bit_cast<std::uint32_t>(b.constant);
}

// An operand of a leaf's step in all of its instances, and the steps before which each instance reads it.
struct LeafOperand {
    std::vector<const NestItem*> loops;
    std::vector<Operand> values;  // indexed by the counters of the loops, the innermost fastest
    std::vector<std::uint32_t> steps;

    std::vector<std::uint32_t> counts() const { return counts_of(loops); }
};

// The counters on which the operands depend.
std::vector<std::uint32_t> counters_that_matter(const LeafOperand& operand) {
    std::vector<std::uint32_t> matter;
    const std::vector<std::uint32_t> counts = operand.counts();
    std::size_t stride = operand.values.size();
    for (std::uint32_t l = 0; l < counts.size(); ++l) {
        stride /= counts[l];
        bool depends = false;
        for (std::size_t i = 0; i < operand.values.size() && !depends; ++i)
            depends = i / stride % counts[l] != 0 && !same(operand.values[i], operand.values[i - stride]);
        if (depends) matter.push_back(l);
    }
    return matter;
}

// The operands with the other counters set to 0.
std::vector<Operand> reduced(const LeafOperand& operand, const std::vector<std::uint32_t>& matter) {
    std::vector<Operand> result;
    Counters counters(operand.counts());
    std::size_t i = 0;
    do {
        bool is_first = true;
        for (std::uint32_t l = 0; l < operand.loops.size(); ++l)
            if (counters[l] != 0 && std::ranges::find(matter, l) == matter.end()) is_first = false;
        if (is_first) result.push_back(operand.values[i]);
        ++i;
    } while (counters.next());
    return result;
}

// Finds readings in a nest. In a trial, the nest is a candidate loop, and values from before it are accepted as they
// are.
class ReadingSearch {
  public:
    ReadingSearch(const Nest& nest, bool is_trial)
        : nest_(nest), is_trial_(is_trial), trial_start_(is_trial ? nest.items().front().offset : 0) {
        result_.of.resize(nest.leaves().size());
        result_.writes.resize(nest.leaves().size());
        result_.inputs.resize(nest.trace().inputs);
        result_.escapes.assign(nest.leaves().size(), 0);
    }

    bool read_leaf(std::uint32_t index) {
        const Leaf& leaf = nest_.leaves()[index];
        const TraceStep& first = nest_.trace().steps[leaf.first];
        for (std::size_t k = 0; k < first.operands; ++k) {
            LeafOperand operand{leaf.loops, {}, {}};
            Counters counters(operand.counts());
            do {
                const std::uint32_t step = step_at(leaf, counters);
                operand.values.push_back(nest_.trace().steps[step].in[k]);
                operand.steps.push_back(step);
            } while (counters.next());
            const auto reading = read(operand);
            if (!reading) return false;
            result_.of[index].push_back(*reading);
        }
        return true;
    }
    bool read_results() {
        const auto end = static_cast<std::uint32_t>(nest_.trace().steps.size());
        for (const Operand& o : nest_.trace().results) {
            const auto reading = read({{}, {o}, {end}});
            if (!reading) return false;
            result_.results.push_back(*reading);
        }
        return true;
    }
    bool write_arrays() {
        for (std::uint32_t a = 0; a < result_.arrays.size(); ++a)
            if (!write_array(a)) return false;
        return true;
    }
    Readings take() { return std::move(result_); }

  private:
    std::int64_t inputs() const { return nest_.trace().inputs; }
    bool is_outside(std::int32_t value) const { return value < trial_start_ + inputs(); }

    std::optional<Reading> read(const LeafOperand& operand) {
        const std::vector<std::uint32_t> matter = counters_that_matter(operand);
        const std::vector<Operand> values = reduced(operand, matter);
        if (std::ranges::all_of(values, &Operand::is_number)) {
            Reading reading{matter.empty() ? Reading::Kind::number : Reading::Kind::table};
            reading.counters = matter;
            for (const Operand& o : values) reading.numbers.push_back(o.constant);
            return reading;
        }
        if (matter.empty() && values[0].value < inputs())
            return Reading{Reading::Kind::input, static_cast<std::uint32_t>(values[0].value)};
        if (matter.empty() && is_outside(values[0].value)) return Reading{Reading::Kind::leaf, 0};
        if (const auto variable = read_variable(operand)) return variable;
        return read_element(values, matter);
    }

    // Reads the latest value of the leaf that computed the operand of the last instance.
    std::optional<Reading> read_variable(const LeafOperand& operand) {
        const Operand& last = operand.values.back();
        if (last.is_number() || last.value < inputs() || is_outside(last.value)) return std::nullopt;
        const std::uint32_t number = nest_.leaf_of(static_cast<std::uint32_t>(last.value - inputs()));
        const Leaf& leaf = nest_.leaves()[number];
        std::vector<std::optional<std::uint32_t>> latest;
        for (const std::uint32_t step : operand.steps) latest.push_back(nest_.latest(leaf, step));
        const auto is_latest = [&](std::size_t i) {
            return latest[i] && operand.values[i].value == static_cast<std::int64_t>(*latest[i]) + inputs();
        };
        bool all = true;
        for (std::size_t i = 0; i < operand.values.size() && all; ++i) all = is_latest(i);
        if (all) {
            const bool is_near = leaf.loops.size() <= operand.loops.size() &&
                                 std::equal(leaf.loops.begin(), leaf.loops.end(), operand.loops.begin());
            if (!is_near) result_.escapes[number] = 1;
            return Reading{Reading::Kind::leaf, number};
        }
        std::size_t common = 0;
        while (common < operand.loops.size() && common < leaf.loops.size() &&
               operand.loops[common] == leaf.loops[common])
            ++common;
        for (std::size_t m = common; m-- > 0;)
            if (const auto carried = read_carried(operand, number, m, latest, is_latest)) return carried;
        return std::nullopt;
    }

    // Does the same if, before the leaf's first value in each execution of the m-th loop, there is a different one.
    template <class IsLatest>
    std::optional<Reading> read_carried(const LeafOperand& operand, std::uint32_t leaf, std::size_t m,
                                        const std::vector<std::optional<std::uint32_t>>& latest,
                                        const IsLatest& is_latest) {
        LeafOperand before{{operand.loops.begin(), operand.loops.begin() + static_cast<std::ptrdiff_t>(m)}, {}, {}};
        Counters counters(operand.counts());
        std::size_t i = 0;
        do {
            std::uint32_t start = 0;
            bool is_first = true;  // of the instances in this execution of the loop
            for (std::size_t l = 0; l < operand.loops.size(); ++l) {
                if (l <= m) start += operand.loops[l]->offset;
                if (l < m) start += operand.loops[l]->period * counters[l];
                if (l >= m && counters[l] != 0) is_first = false;
            }
            const bool is_start = !latest[i] || *latest[i] < start;
            if (is_first) {
                if (!is_start) return std::nullopt;
                before.values.push_back(operand.values[i]);
                before.steps.push_back(start);
            } else if (is_start ? !same(operand.values[i], before.values.back()) : !is_latest(i)) {
                return std::nullopt;
            }
            ++i;
        } while (counters.next());
        for (std::uint32_t c = 0; c < result_.carried.size(); ++c) {
            const CarriedVariable& known = result_.carried[c];
            if (known.leaf == leaf && known.loop == operand.loops[m] &&
                std::ranges::equal(known.starts, before.values, same))
                return Reading{Reading::Kind::carried, c};
        }
        const auto start = read(before);
        if (!start) return std::nullopt;
        result_.carried.push_back({leaf, operand.loops[m], before.values, *start});
        return Reading{Reading::Kind::carried, static_cast<std::uint32_t>(result_.carried.size() - 1)};
    }

    std::optional<Reading> read_element(const std::vector<Operand>& values, const std::vector<std::uint32_t>& matter) {
        ValueArray array;
        for (const Operand& o : values) {
            if (o.is_number()) return std::nullopt;
            const bool rises = array.values.empty() || o.value > array.values.back();
            if (is_trial_ && !(is_outside(o.value) && rises)) return std::nullopt;
            array.values.push_back(o.value);
        }
        for (std::uint32_t a = 0; a < result_.arrays.size(); ++a)
            if (result_.arrays[a].values == array.values) return Reading{Reading::Kind::element, a, {}, matter};
        array.highest = static_cast<std::int64_t>(array.values.size()) - 1;
        result_.arrays.push_back(std::move(array));
        return Reading{Reading::Kind::element, static_cast<std::uint32_t>(result_.arrays.size() - 1), {}, matter};
    }

    bool write_array(std::uint32_t index) {
        const std::vector<std::int32_t>& values = result_.arrays[index].values;
        std::map<std::int32_t, std::int64_t> elements;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!elements.emplace(values[i], static_cast<std::int64_t>(i)).second) return false;
        std::vector<char> is_done(nest_.leaves().size(), 0);
        for (const auto& [value, element] : elements) {
            if (value < inputs()) {
                result_.inputs[static_cast<std::size_t>(value)].push_back({index, element, {}});
                continue;
            }
            const std::uint32_t number = nest_.leaf_of(static_cast<std::uint32_t>(value - inputs()));
            if (is_done[number]) continue;
            is_done[number] = 1;
            if (!write_instances(index, number, elements)) return false;
        }
        return true;
    }
    // Finds the array elements to which all instances of a leaf are written. The elements of instances that are read
    // are known, and must be linear in the counters; other instances go to elements around them.
    bool write_instances(std::uint32_t array, std::uint32_t number,
                         const std::map<std::int32_t, std::int64_t>& elements) {
        const Leaf& leaf = nest_.leaves()[number];
        const std::size_t depth = leaf.loops.size();
        struct Instance {
            std::vector<std::uint32_t> counters;
            std::optional<std::int64_t> element;
        };
        std::vector<Instance> instances;
        Counters counters(counts_of(leaf.loops));
        do {
            Instance instance;
            for (std::size_t l = 0; l < depth; ++l) instance.counters.push_back(counters[l]);
            const auto found = elements.find(static_cast<std::int32_t>(step_at(leaf, counters) + inputs()));
            if (found != elements.end()) instance.element = found->second;
            instances.push_back(std::move(instance));
        } while (counters.next());
        const auto first = std::ranges::find_if(instances, [](const Instance& i) { return i.element.has_value(); });
        ElementWrite write{array, *first->element, {}};
        const auto count = static_cast<std::int64_t>(result_.arrays[array].values.size());
        for (std::size_t l = 0; l < depth; ++l) {
            const auto other = std::ranges::find_if(instances, [&](const Instance& i) {
                bool differs_here_alone = i.element && i.counters[l] != first->counters[l];
                for (std::size_t m = 0; m < depth; ++m)
                    differs_here_alone = differs_here_alone && (m == l || i.counters[m] == first->counters[m]);
                return differs_here_alone;
            });
            const auto step = [&] {
                return static_cast<std::int64_t>(other->counters[l]) - static_cast<std::int64_t>(first->counters[l]);
            };
            write.factors.push_back(other == instances.end() ? count : (*other->element - *first->element) / step());
        }
        for (std::size_t l = 0; l < depth; ++l) write.first -= write.factors[l] * first->counters[l];
        ValueArray& to = result_.arrays[array];
        for (const Instance& i : instances) {
            std::int64_t element = write.first;
            for (std::size_t l = 0; l < depth; ++l) element += write.factors[l] * i.counters[l];
            if (i.element ? element != *i.element : element >= 0 && element < count) return false;
            to.lowest = std::min(to.lowest, element);
            to.highest = std::max(to.highest, element);
        }
        result_.writes[number].push_back(std::move(write));
        return to.size() <= largest_spare * to.values.size();
    }

    const Nest& nest_;
    bool is_trial_;
    std::int64_t trial_start_;
    Readings result_;
};

}  // namespace

std::optional<Readings> readings_of(const Nest& nest) {
    ReadingSearch search(nest, false);
    for (std::uint32_t i = 0; i < nest.leaves().size(); ++i)
        if (!search.read_leaf(i)) return std::nullopt;
    if (!search.read_results() || !search.write_arrays()) return std::nullopt;
    return search.take();
}

bool is_loop(const Trace& trace, const NestItem& loop) {
    const Nest nest(trace, {loop});
    ReadingSearch search(nest, true);
    for (std::uint32_t i = 0; i < nest.leaves().size(); ++i)
        if (!search.read_leaf(i)) return false;
    return true;
}

}  // namespace phasetree::glsl
