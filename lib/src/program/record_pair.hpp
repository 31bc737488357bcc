#pragma once

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// Records two objects as one program, in which equal subtrees are the same instructions. Its first outputs are those
/// of the first object.
struct RecordedPair {
    Program program;
    std::size_t outputs_of_first = 0;
};
RecordedPair record_pair(const Phased& first, const Phased& second, std::size_t limit = 500'000);

}  // namespace phasetree::program
