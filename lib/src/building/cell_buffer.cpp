#include "building/cell_buffer.hpp"

namespace phasetree::building {

namespace {

template <class T, class From>
void append_to(std::vector<T>& to, const From& from) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::size_t CellBuffer::bytes(const Mark& from, const Mark& to) {
    return 2 * sizeof(Cell) * (to.cells - from.cells) + 2 * sizeof(Instruction) * (to.code - from.code) +
           2 * sizeof(ProgramOutput) * (to.outputs - from.outputs) +
           2 * sizeof(CertificateStep) * (to.certificates - from.certificates) +
           3 * sizeof(float) * (to.specialised_data - from.specialised_data) +
           2 * sizeof(CellFaces) * (to.cell_faces - from.cell_faces) +
           3 * sizeof(FaceCorners) * (to.faces - from.faces);
}

// Calls f with each vector and its size at the mark.
template <class F>
void CellBuffer::for_each_vector(const Mark& m, F&& f) {
    f(cells, m.cells);
    f(code, m.code);
    f(outputs, m.outputs);
    f(certificates, m.certificates);
    f(specialised_data, m.specialised_data);
    f(cell_faces, m.cell_faces);
    f(faces, m.faces);
}

void CellBuffer::discard_from(const Mark& m) {
    for_each_vector(m, [](auto& vector, std::size_t count) { vector.resize(count); });
}

void CellBuffer::reserve(const Mark& m) {
    for_each_vector(m, [](auto& vector, std::size_t count) { vector.reserve(count); });
}

void CellBuffer::add(Cell cell, const WorkingProgram& program, std::span<const CertificateStep> certificate,
                     std::span<const FaceCorners> faces_in_box) {
    cell.first_instruction = narrow(code.size());
    cell.instructions = narrow(program.code.size());
    cell.first_output = narrow(outputs.size());
    cell.outputs = narrow(program.outputs.size());
    cell.first_certificate_step = narrow(certificates.size());
    cell.certificate_steps = narrow(certificate.size());
    append_to(code, program.code);
    append_to(outputs, program.outputs);
    append_to(certificates, certificate);
    if (!faces_in_box.empty())
        cell_faces.push_back({narrow(cells.size()), narrow(faces.size()), narrow(faces_in_box.size())});
    append_to(faces, faces_in_box);
    cells.push_back(cell);
}

void CellBuffers::discard_from(const Mark& m) {
    buffers_.resize(m.buffers);
    buffers_.back().discard_from(m.last);
}

CellBuffer& CellBuffers::last() {
    if (buffers_.back().cells.size() >= cells_in_full_buffer) {
        const CellBuffer::Mark full = buffers_.back().mark();
        buffers_.emplace_back().reserve(full);
    }
    return buffers_.back();
}

void CellBuffers::append(CellBuffers& more) {
    for (CellBuffer& buffer : more.buffers_)
        if (!buffer.cells.empty()) {
            // Up to half of a vector's capacity may be unused, because it has grown, or was made as large as the
            // previous one.
            buffer.for_each_vector(buffer.mark(), [](auto& vector, std::size_t) { vector.shrink_to_fit(); });
            buffers_.push_back(std::move(buffer));
        }
    more.buffers_ = std::vector<CellBuffer>(1);
}

std::size_t CellBuffers::cells() const {
    std::size_t sum = 0;
    for (const CellBuffer& buffer : buffers_) sum += buffer.cells.size();
    return sum;
}

}  // namespace phasetree::building
