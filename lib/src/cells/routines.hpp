#pragma once

#include <span>
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
    /// Makes what localised instructions want constants. To be called before add() with what was found there.
    void take_near(Found&);
    /// What was found must stay as long as others are added.
    const Ready& add(const Found&, const Found::Cell&);
    /// The proof of a cell whose routine this is, appended.
    void add_proof(const Ready&, std::span<const ProofPart>, std::vector<ProofStep>&) const;

    std::size_t count() const { return known_.size(); }
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;

  private:
    Ready make(const Found&, const Found::Cell&);

    /// A cell's program, where it was found.
    struct Key {
        const Found* found;
        const Found::Cell* cell;
        std::size_t hash;

        bool operator==(const Key&) const;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const { return key.hash; }
    };
    static Key key_of(const Found&, const Found::Cell&);

    Fuser fuse_;
    std::unordered_map<Key, Ready, Hash> known_;
    std::vector<std::uint32_t> kept_, kept_slots_;
};

}  // namespace phasetree
