#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "cells/found.hpp"
#include "cells/fuse.hpp"

namespace phasetree {

/// Cells' programs made ready to run, equal ones once.
class Routines {
  public:
    /// Constants of fused instructions are appended to these.
    explicit Routines(std::vector<float>& constants) : fuse_(constants) {}

    struct Ready {
        std::uint32_t first_step, steps, leading, first_output, outputs, slots;
        std::uint32_t first_kept;  ///< where the slots start of the values that the proof speaks of, in its order
    };
    const Ready& add(const Found&, const Found::Cell&);
    /// The proof of a cell whose routine this is, appended.
    void add_proof(const Ready&, std::span<const ProofPart>, std::vector<ProofStep>&) const;

    std::size_t count() const { return known_.size(); }
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;

  private:
    Ready make(const Found&, const Found::Cell&);

    Fuser fuse_;
    std::unordered_map<std::u32string, Ready> known_;
    std::u32string key_;
    std::vector<std::uint32_t> kept_, kept_slots_;
};

}  // namespace phasetree
