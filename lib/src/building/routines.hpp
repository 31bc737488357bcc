#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "building/cell_buffer.hpp"
#include "evaluation/assemble.hpp"
#include "rewriting/fuse.hpp"

namespace phasetree::building {

using evaluation::Assembly;
using kernel::OutputSlot, kernel::PackedCertificateStep, kernel::Routine, kernel::Step;
using rewriting::Fuser;

/// Many routines, as steps and as where each step's constants are. Those of one shape differ in the latter only, and
/// shapes are so few that caches hold them.
struct RoutineTables {
    struct Shape {
        std::uint32_t first_step, steps, leading, first_output, outputs, slots;
    };
    std::vector<Shape> shapes;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;
    std::vector<std::uint32_t> data;

    Routine routine(const Shape& s, std::uint32_t first_data, const float* constants) const {
        Routine r{steps.data() + s.first_step,
                  data.data() + first_data,
                  constants,
                  s.steps,
                  outputs.data() + s.first_output,
                  s.outputs};
        r.leading = s.leading;
        return r;
    }
    std::size_t bytes() const {
        return shapes.size() * sizeof(Shape) + steps.size() * sizeof(Step) + outputs.size() * sizeof(OutputSlot) +
               data.size() * sizeof(data[0]);
    }
    void shrink_to_fit() {
        shapes.shrink_to_fit();
        steps.shrink_to_fit();
        outputs.shrink_to_fit();
        data.shrink_to_fit();
    }
};

/// Cells' programs made ready to run, equal ones once.
class Routines {
  public:
    /// Constants of fused instructions are appended to these.
    explicit Routines(std::vector<float>& constants) : fuse_(constants) {}

    struct Ready {
        std::uint32_t shape, first_data;
        std::uint32_t first_kept;  ///< where the slots start of the values that the certificate speaks of, in its order
    };
    /// Makes what localised instructions want constants. To be called before add() with what was found there.
    void take_specialised_data(CellBuffer&);
    /// What was found must stay as long as others are added.
    const Ready& add(const CellBuffer&, const CellBuffer::Cell&);
    /// The certificate of a cell whose routine this is, appended.
    void add_certificate(const Ready&, std::span<const CertificateStep>, std::vector<PackedCertificateStep>&) const;

    std::size_t count() const { return known_.size(); }
    RoutineTables tables;

  private:
    Ready make(const CellBuffer&, const CellBuffer::Cell&);
    std::uint32_t shape_of(const Assembly&, std::uint32_t leading);

    /// A cell's program, where it was found.
    struct Key {
        const CellBuffer* found;
        const CellBuffer::Cell* cell;
        std::size_t hash;

        bool operator==(const Key&) const;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const { return key.hash; }
    };
    static Key key_of(const CellBuffer&, const CellBuffer::Cell&);

    Fuser fuse_;
    std::unordered_map<Key, Ready, Hash> known_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> shapes_;  ///< by a hash
    std::vector<std::uint32_t> kept_, kept_slots_;
};

}  // namespace phasetree::building
