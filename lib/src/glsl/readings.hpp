#pragma once

#include <vector>

#include "glsl/nest.hpp"

namespace phasetree::glsl {

/// Where a step that is written once finds an operand, in all of its instances.
struct Reading {
    enum class Kind {
        input,    ///< a value that the function takes
        number,   ///< the same number in all instances
        table,    ///< a number that depends on counters
        leaf,     ///< what a leaf has computed last
        carried,  ///< the same, or what was there before a loop began
        element   ///< of an array that leaves fill, by counters
    };
    Kind kind{};
    std::uint32_t index = 0;                ///< of the input, the leaf, or in Readings: carried variable, array
    std::vector<float> numbers{};           ///< one, or those of the table, the innermost counter fastest
    std::vector<std::uint32_t> counters{};  ///< which counters of the loops around it a table or array is indexed by
};

/// A variable that is set before a loop begins, and in it by a leaf.
struct CarriedVariable {
    std::uint32_t leaf;
    const NestItem* loop;
    std::vector<Operand> starts;  ///< by the counters of the loops around the loop
    Reading start;
};
/// Values of several instances that are read by an index.
struct ValueArray {
    std::vector<std::int32_t> values;      ///< of the trace, at the indices from 0 on
    std::int64_t lowest = 0, highest = 0;  ///< indices; those beyond the values hold what is never read

    std::size_t size() const { return static_cast<std::size_t>(highest - lowest + 1); }
};
/// An assignment of a leaf's value to an element of an array: the index is linear in the leaf's counters.
struct ElementWrite {
    std::uint32_t array = 0;
    std::int64_t first = 0;
    std::vector<std::int64_t> factors{};
};

/// How all leaves of a nest find their operands, if the nest's loops can be written.
struct Readings {
    std::vector<std::vector<Reading>> of;  ///< for each leaf its operands
    std::vector<Reading> results;
    std::vector<CarriedVariable> carried;
    std::vector<ValueArray> arrays;
    std::vector<std::vector<ElementWrite>> writes;  ///< for each leaf
    std::vector<std::vector<ElementWrite>> inputs;  ///< for each input
    std::vector<char> escapes;  ///< for each leaf, whether it is read outside of the iteration that computes it
};

/// Nothing if the nest's loops cannot be written.
std::optional<Readings> readings_of(const Nest&);

/// Whether a loop among items that are not in loops can be written, as far as can be told without what becomes of the
/// steps before it: its steps' operands must be values from before it that are the same in all iterations or rise from
/// one to the next, of the same iteration, or of the latest one.
bool is_loop(const Trace&, const NestItem&);

}  // namespace phasetree::glsl
