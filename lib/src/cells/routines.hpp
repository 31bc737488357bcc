#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "building/cell_buffer.hpp"
#include "evaluation/assemble.hpp"
#include "rewriting/fuse.hpp"

namespace phasetree::cells {

using bounding::CertificateStep;
using building::CellBuffer;
using evaluation::Assembly;
using kernel::OutputSlot, kernel::PackedCertificateStep, kernel::Routine, kernel::Step;
using rewriting::Fuser;

/// The routines of all cells. Routines that differ only in the location of their constants share a shape, so that all
/// shapes fit in the processor's caches.
struct RoutineTables {
    /// A routine without its constants: ranges of the vectors below, and the number of steps that compute the first
    /// component alone.
    struct Shape {
        std::uint32_t first_step, steps, first_component_steps, first_output, outputs, slots;
    };
    std::vector<Shape> shapes;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;
    std::vector<std::uint32_t> data;  ///< Routine::data of all routines

    Routine routine(const Shape& s, std::uint32_t first_data, const float* constants) const {
        Routine r{steps.data() + s.first_step,
                  data.data() + first_data,
                  constants,
                  s.steps,
                  outputs.data() + s.first_output,
                  s.outputs};
        r.first_component_steps = s.first_component_steps;
        return r;
    }
    std::size_t bytes() const;
    void shrink_to_fit();
};

/// Builds the routines of cells by fusing and assembling their programs. Equal programs share a routine.
class RoutineBuilder {
  public:
    /// Constants of fused instructions are appended to `constants`.
    explicit RoutineBuilder(std::vector<float>& constants) : fuse_(constants) {}

    /// A routine, and where its certificate finds its values.
    struct BuiltRoutine {
        std::uint32_t shape, first_data;
        /// The index in `kept_slots_` of the first slot for the leaves of this routine's certificate, in the order of
        /// the leaves.
        std::uint32_t first_kept;
    };
    /// Turns the data of specialised instructions (rewriting/specialise.hpp) into constants. Call it once per buffer,
    /// before adding the cells in it.
    void intern_specialised_data(CellBuffer&);
    /// The routine of a cell. The buffer must not move or be destroyed while cells are being added.
    const BuiltRoutine& add(const CellBuffer&, const CellBuffer::Cell&);
    /// Appends a certificate for this routine.
    void pack_certificate(const BuiltRoutine&, std::span<const CertificateStep>,
                          std::vector<PackedCertificateStep>&) const;

    /// The number of different programs added.
    std::size_t count() const { return built_.size(); }
    RoutineTables tables;

  private:
    BuiltRoutine build(const CellBuffer&, const CellBuffer::Cell&);
    std::uint32_t intern_shape(const Assembly&, std::uint32_t first_component_steps);

    /// The program of a cell, with the values that its certificate needs.
    struct Key {
        const CellBuffer* buffer;
        const CellBuffer::Cell* cell;
        std::size_t hash;

        bool operator==(const Key&) const;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const { return key.hash; }
    };
    static Key key_of(const CellBuffer&, const CellBuffer::Cell&);

    Fuser fuse_;
    std::unordered_map<Key, BuiltRoutine, Hash> built_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> shapes_;  ///< indices of shapes by hash
    std::vector<std::uint32_t> kept_values_;  ///< of the certificate leaves of the cell being added
    std::vector<std::uint32_t> kept_slots_;   ///< of the certificate leaves of all routines
};

}  // namespace phasetree::cells
