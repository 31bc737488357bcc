#pragma once

#include <utility>
#include <vector>

#include "bounding/sign_certificate.hpp"
#include "kernel/linear_bound.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::building {

using bounding::CertificateStep;
using kernel::Curvature, kernel::LinearBound;
using program::ProgramOutput;
using rewriting::WorkingProgram;

/// Cells found so far, in order, with their programs.
struct CellBuffer {
    struct Cell {
        Bounds box;
        LinearBound bound;
        Curvature curvature;
        std::uint32_t first_instruction, instructions, leading, first_output, outputs, first_certificate,
            certificate_parts;
    };
    std::vector<Cell> cells;
    std::vector<Instruction> code;
    std::vector<ProgramOutput> outputs;
    std::vector<CertificateStep> certificates;
    std::vector<float> specialised_data;  ///< the data of specialised instructions

    struct Mark {
        std::size_t cells, code, outputs, certificates, specialised_data;
    };
    /// About what a cell of so much takes as long as it exists, and Embree's tree over it: as it was found, its box and
    /// bound again, its routine or that which it shares, and what vectors and tables have to spare.
    static std::size_t bytes(const Mark& from, const Mark& to) {
        return per_cell * (to.cells - from.cells) + per_instruction * (to.code - from.code) +
               2 * sizeof(ProgramOutput) * (to.outputs - from.outputs) +
               2 * sizeof(CertificateStep) * (to.certificates - from.certificates) +
               3 * sizeof(float) * (to.specialised_data - from.specialised_data);
    }
    Mark mark() const {
        return {cells.size(), code.size(), outputs.size(), certificates.size(), specialised_data.size()};
    }
    void forget_from(const Mark& m) {
        each(m, [](auto& of, std::size_t count) { of.resize(count); });
    }
    void reserve(const Mark& m) {
        each(m, [](auto& of, std::size_t count) { of.reserve(count); });
    }
    void add(const Bounds& box, const LinearBound& bound, const Curvature& curvature, const WorkingProgram& program,
             std::uint32_t leading, std::span<const CertificateStep> certificate) {
        const Mark m = mark();
        append(code, program.code);
        append(outputs, program.outputs);
        append(certificates, certificate);
        cells.push_back({box, bound, curvature, narrow(m.code), narrow(program.code.size()), leading, narrow(m.outputs),
                         narrow(program.outputs.size()), narrow(m.certificates), narrow(certificate.size())});
    }
    static std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }

    std::span<const Instruction> code_of(const Cell& c) const {
        return std::span(code).subspan(c.first_instruction, c.instructions);
    }
    std::span<const ProgramOutput> outputs_of(const Cell& c) const {
        return std::span(outputs).subspan(c.first_output, c.outputs);
    }
    std::span<const CertificateStep> certificate_of(const Cell& c) const {
        return std::span(certificates).subspan(c.first_certificate, c.certificate_parts);
    }

  private:
    static constexpr std::size_t per_cell = 2 * sizeof(Cell), per_instruction = 2 * sizeof(Instruction);

    template <class F>
    void each(const Mark& m, F&& f) {
        f(cells, m.cells);
        f(code, m.code);
        f(outputs, m.outputs);
        f(certificates, m.certificates);
        f(specialised_data, m.specialised_data);
    }
    template <class T, class From>
    static void append(std::vector<T>& to, const From& from) {
        to.insert(to.end(), from.begin(), from.end());
    }
};

/// The same in pieces: what others have found is taken over, and none of it copied.
class CellBuffers {
  public:
    struct Mark {
        std::size_t pieces;
        CellBuffer::Mark last;
    };
    Mark mark() const { return {pieces_.size(), pieces_.back().mark()}; }
    void forget_from(const Mark& m) {
        pieces_.resize(m.pieces);
        pieces_.back().forget_from(m.last);
    }
    /// The piece to which more can be added: a new one after so many cells, because to move them takes time.
    CellBuffer& last() {
        if (pieces_.back().cells.size() >= most_cells) {
            const CellBuffer::Mark full = pieces_.back().mark();
            pieces_.emplace_back().reserve(full);
        }
        return pieces_.back();
    }
    /// All of another's, which has nothing then.
    void take(CellBuffers& more) {
        for (CellBuffer& piece : more.pieces_)
            if (!piece.cells.empty()) pieces_.push_back(std::move(piece));
        more.pieces_ = std::vector<CellBuffer>(1);
    }
    std::size_t cells() const {
        std::size_t sum = 0;
        for (const CellBuffer& piece : pieces_) sum += piece.cells.size();
        return sum;
    }
    auto begin() { return pieces_.begin(); }
    auto end() { return pieces_.end(); }

  private:
    static constexpr std::size_t most_cells = 4096;

    std::vector<CellBuffer> pieces_ = std::vector<CellBuffer>(1);
};

}  // namespace phasetree::building
