#pragma once

#include <vector>

#include "glsl/nest.hpp"

namespace phasetree::glsl {

/// Where a step that is written once finds an operand in all of its instances.
struct Reading {
    enum class Kind {
        input,    ///< a parameter of the function
        number,   ///< the same number in all instances
        table,    ///< a number that depends on counters
        leaf,     ///< the latest value of a leaf
        carried,  ///< the latest value of a leaf, or a value from before a loop began
        element   ///< an element, chosen by counters, of an array filled by leaves
    };
    Kind kind{};
    std::uint32_t index = 0;                ///< of the input or the leaf; in Readings, of the carried variable or the
                                            ///< array
    std::vector<float> numbers{};           ///< a single number, or those of the table, with the innermost counter
                                            ///< fastest
    std::vector<std::uint32_t> counters{};  ///< the counters of surrounding loops by which a table or array is indexed
};

/// A variable that is initialised before a loop, and assigned by a leaf inside it.
struct CarriedVariable {
    std::uint32_t leaf;
    const NestItem* loop;
    std::vector<Operand> starts;  ///< indexed by the counters of the loops around the loop
    Reading start;
};
/// Values of several instances, read by index.
struct ValueArray {
    std::vector<std::int32_t> values;      ///< values of the trace, for the indices from 0 on
    std::int64_t lowest = 0, highest = 0;  ///< range of indices; elements outside `values` are never read

    std::size_t size() const { return static_cast<std::size_t>(highest - lowest + 1); }
};
/// Assigns a leaf's value to an array element whose index is linear in the leaf's counters.
struct ElementWrite {
    std::uint32_t array = 0;
    std::int64_t first = 0;
    std::vector<std::int64_t> factors{};
};

/// How all leaves of a nest find their operands, if the nest's loops can be written.
struct Readings {
    std::vector<std::vector<Reading>> of;  ///< for each leaf, its operands
    std::vector<Reading> results;
    std::vector<CarriedVariable> carried;
    std::vector<ValueArray> arrays;
    std::vector<std::vector<ElementWrite>> writes;  ///< for each leaf
    std::vector<std::vector<ElementWrite>> inputs;  ///< for each input
    std::vector<char> escapes;  ///< for each leaf, whether it is read outside the iteration that computes it
};

/// Returns nullopt if the nest's loops cannot be written.
std::optional<Readings> readings_of(const Nest&);

/// Whether a loop among items that are not in loops can be written, as far as this is known before the preceding steps
/// are processed. Each operand must be a value of the same iteration, a value of the latest iteration, or a value from
/// before the loop. The last kind must be the same in all iterations or advance from one to the next.
bool is_loop(const Trace&, const NestItem&);

}  // namespace phasetree::glsl
