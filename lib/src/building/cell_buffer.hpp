#pragma once

#include <utility>
#include <vector>

#include "bounding/sign_certificate.hpp"
#include "building/lone_mesh.hpp"
#include "kernel/linear_bound.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::building {

using bounding::CertificateStep;
using kernel::Curvature, kernel::LinearBound;
using program::ProgramOutput;
using rewriting::WorkingProgram;

/// Cells with their programs, in the order in which they were found. It is a stack: the last cells can be discarded.
struct CellBuffer {
    /// A cell, whose program and certificate are ranges of the vectors below.
    struct Cell {
        Bounds box;
        LinearBound bound;
        Curvature curvature;
        std::uint32_t first_instruction = 0, instructions = 0;
        std::uint32_t first_component_steps = 0;  ///< Routine::first_component_steps
        std::uint32_t first_output = 0, outputs = 0;
        std::uint32_t first_certificate_step = 0, certificate_steps = 0;
    };
    /// The faces of a cell whose program is a single mesh, as a range of the vector below.
    struct CellFaces {
        std::uint32_t cell, first, count;
    };
    std::vector<Cell> cells;
    std::vector<Instruction> code;
    std::vector<ProgramOutput> outputs;
    std::vector<CertificateStep> certificates;
    std::vector<float> specialised_data;  ///< the data of specialised instructions
    std::vector<CellFaces> cell_faces;    ///< in the order of the cells
    std::vector<FaceCorners> faces;

    /// The sizes of these vectors at some point.
    struct Mark {
        std::size_t cells, code, outputs, certificates, specialised_data, cell_faces, faces;
    };
    Mark mark() const {
        return {cells.size(),      code.size(), outputs.size(), certificates.size(), specialised_data.size(),
                cell_faces.size(), faces.size()};
    }
    /// The approximate number of bytes that the cells between two marks take during their lifetime, including Embree's
    /// tree over them. It consists of the cells as found; another copy of their boxes and bounds; their routines, or
    /// those that they share; and the unused capacity of vectors and tables.
    static std::size_t bytes(const Mark& from, const Mark& to);
    void discard_from(const Mark&);
    void reserve(const Mark&);

    /// Appends a cell. `cell` contains its box and what is known in it; this function sets its other members.
    void add(Cell cell, const WorkingProgram&, std::span<const CertificateStep>, std::span<const FaceCorners>);

    std::span<const Instruction> code_of(const Cell& c) const {
        return std::span(code).subspan(c.first_instruction, c.instructions);
    }
    std::span<const ProgramOutput> outputs_of(const Cell& c) const {
        return std::span(outputs).subspan(c.first_output, c.outputs);
    }
    std::span<const CertificateStep> certificate_of(const Cell& c) const {
        return std::span(certificates).subspan(c.first_certificate_step, c.certificate_steps);
    }

    std::span<const FaceCorners> faces_of(const CellFaces& c) const {
        return std::span(faces).subspan(c.first, c.count);
    }

  private:
    friend class CellBuffers;
    template <class F>
    void for_each_vector(const Mark&, F&&);
};

/// A sequence of buffers. Those of other workers can be appended without copying their cells.
class CellBuffers {
  public:
    struct Mark {
        std::size_t buffers;
        CellBuffer::Mark last;
    };
    Mark mark() const { return {buffers_.size(), buffers_.back().mark()}; }
    void discard_from(const Mark&);
    /// The buffer for the next cell. Starts a new one when it is full, because a growing vector moves its contents.
    CellBuffer& last();
    /// Takes all cells of another sequence, leaving it empty.
    void append(CellBuffers&);
    std::size_t cells() const;
    auto begin() { return buffers_.begin(); }
    auto end() { return buffers_.end(); }

  private:
    static constexpr std::size_t cells_in_full_buffer = 4096;

    std::vector<CellBuffer> buffers_ = std::vector<CellBuffer>(1);
};

/// Indices have 32 bits. No table of cells has 2³² entries, because a budget is at most 64 GiB (cells/data.cpp).
inline std::uint32_t narrow(std::size_t n) {
    return static_cast<std::uint32_t>(n);
}

}  // namespace phasetree::building
