// Damaged cell files are rejected or harmless: truncated files, changed bytes, forged counts and checksums.
#include <algorithm>
#include <array>
#include <memory>

#include "cells/cells_files.hpp"
#include "cells/validate.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/ray.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"
#include "support/long_tests.hpp"

namespace test_damaged_files {

using namespace phasetree;
using namespace phasetree::tests;

using cells::CellTables, cells::Checksum, cells::InterfaceCell, cells::describe_damage;

namespace {

std::optional<Crossing> nearest(const InterfaceCells& cells, const glm::vec3& from, const glm::vec3& direction) {
    std::optional<Crossing> hit;
    TraceCounters counters;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto one = cells.first_crossing(c, TracedRay(from, direction), 0, hit ? hit->t_from : 10.f, std::nullopt,
                                              {}, counters);
        if (one && (!hit || one->t_from < hit->t_from)) hit = one;
    }
    return hit;
}

// Corrects the checksums of a changed file.
void forge(Bytes& file) {
    CellsFileHeader h = header_of(file);
    constexpr std::array<std::size_t, CellsFileHeader::sections> size{64, 24, 16, 12, 4, 16, 4, 288, 4, 4};
    Checksum sum;
    std::size_t at = sizeof h;
    for (std::size_t i = 0; i < size.size(); ++i) {
        sum.put(file.data() + at, h.counts[i] * size[i]);
        at += h.counts[i] * size[i];
    }
    REQUIRE(at == file.size());
    h.tables_checksum = sum.get();
    set_header(file, h);
}

}  // namespace

TEST_CASE("a file that ends too early is rejected wherever it ends") {
    const Written w;
    const std::size_t step = long_tests() ? 1 : 1 + w.bytes.size() / 2000;
    const fs::path path = w.folder / "short";
    for (std::size_t size = w.bytes.size(); size-- > 0; size -= std::min(size, step - 1)) {
        put(path, Bytes(w.bytes.begin(), w.bytes.begin() + static_cast<std::ptrdiff_t>(size)));
        CAPTURE(size);
        REQUIRE(refusal(path, w.object) == (size < 8 ? Reason::foreign : Reason::damaged));
    }
}

TEST_CASE("every changed byte is found") {
    const Written w;
    MESSAGE(w.bytes.size(), " bytes");
    Random rng(23);
    const fs::path path = w.folder / "changed";
    const std::size_t step = long_tests() ? 1 : 1 + w.bytes.size() / 4000;
    for (std::size_t at = 0; at < w.bytes.size(); at += at < sizeof(CellsFileHeader) ? 1 : step) {
        Bytes file = w.bytes;
        file[at] ^= static_cast<unsigned char>(1 << rng.below(8));
        put(path, file);
        CAPTURE(at);
        REQUIRE(refusal(path, w.object));
    }
}

TEST_CASE("no count in a header makes more memory be allocated than the file has bytes") {
    const Written w;
    for (std::size_t i = 0; i < CellsFileHeader::sections; ++i) {
        for (const std::uint64_t count : {~std::uint64_t{0}, std::uint64_t{1} << 62, std::uint64_t{1} << 32,
                                          header_of(w.bytes).counts[i] + 1, header_of(w.bytes).counts[i] - 1}) {
            Bytes file = w.bytes;
            CellsFileHeader h = header_of(file);
            h.counts[i] = count;
            set_header(file, h);
            put(w.folder / "forged", file);
            CHECK(refusal(w.folder / "forged", w.object) == Reason::damaged);
        }
    }
}

TEST_CASE("forged checksums do not make a ray read what is not there") {
    const Written w;
    Random rng(29);
    const fs::path path = w.folder / "forged";
    int accepted = 0, refused = 0;
    const int count = long_tests() ? 200'000 : 2'000;
    for (int n = 0; n < count; ++n) {
        Bytes file = w.bytes;
        const int changes = 1 + rng.below(3);
        for (int k = 0; k < changes; ++k) {
            const auto at =
                sizeof(CellsFileHeader) +
                static_cast<std::size_t>(rng.below(static_cast<int>(file.size() - sizeof(CellsFileHeader))));
            const int kind = rng.below(3);
            if (kind == 0)
                file[at] ^= static_cast<unsigned char>(1 << rng.below(8));
            else if (kind == 1)
                file[at] = static_cast<unsigned char>(rng.below(256));
            else  // a word, as all ones or as another's
                for (std::size_t i = at / 4 * 4; i < std::min(at / 4 * 4 + 4, file.size()); ++i)
                    file[i] = n % 2 == 0 ? 255 : file[rng.below(2) ? i - 4 : i];
        }
        forge(file);
        put(path, file);
        std::shared_ptr<const InterfaceCells> cells;
        try {
            cells = read_cells(path, w.object, few);
        } catch (const CellsFileError& e) {
            REQUIRE(e.reason() == Reason::damaged);
            ++refused;
            continue;
        }
        ++accepted;
        for (int i = 0; i < 4; ++i) {
            const glm::vec3 d = rng.direction(), o = 0.5f * rng.direction() - static_cast<float>(i % 2) * 3.f * d;
            if (const auto c = nearest(*cells, o, d)) {
                REQUIRE(c->from.index < Phase::capacity);
                REQUIRE(c->to.index < Phase::capacity);
                for (std::size_t cell = 0; cell < cells->size(); cell += 1 + cells->size() / 4)
                    (void)cells->normal(cell, *c, d);
            }
        }
    }
    MESSAGE(accepted, " accepted, ", refused, " refused");
    CHECK(accepted > count / 20);
    CHECK(refused > count / 20);
}

namespace {

// One cell whose program is one step with the data at `data`.
std::string unsound(const Program& program, std::uint32_t op, std::uint32_t data) {
    CellTables t;
    t.routines.shapes = {
        {.first_step = 0, .steps = 1, .first_component_steps = 0, .first_output = 0, .outputs = 1, .slots = 4}};
    t.routines.steps = {{.op = op, .to = 3, .a = 0, .b = 0}};
    t.routines.outputs = {{.slot = 3, .phase = 1, .sign = 1}};
    t.routines.data = {data};
    t.cells = {InterfaceCell{}};
    t.first_certificate = {0, 0};
    return describe_damage(t, program);
}

}  // namespace

TEST_CASE("a primitive with data may refer to its own data in the object, or to a complete list of sites") {
    const Program polygon = record(various());
    int found = 0;
    for (const Instruction& in : polygon.instructions) {
        const auto op = static_cast<std::uint32_t>(in.op);
        if (op !=
            static_cast<std::uint32_t>(Op::first_primitive) + Primitives::size + index_in<Polygon>(DataPrimitives()))
            continue;
        ++found;
        CHECK(unsound(polygon, op, in.data).empty());
        CHECK_FALSE(unsound(polygon, op, in.data + 1).empty());
        CHECK_FALSE(unsound(polygon, op, 0xffffffff).empty());
        CHECK_FALSE(unsound(polygon, op + 1, in.data).empty());
    }
    CHECK(found == 1);
    const auto near = static_cast<std::uint32_t>(static_cast<std::size_t>(Op::first_primitive) + Primitives::size +
                                                 index_in<VoronoiCells::Specialised>(DataPrimitives()));
    const auto with_count = [&](float count) {
        Program blocks;
        blocks.constants = {1, 0.05f, 0.02f, 0.9f, 0, count};
        blocks.constants.resize(blocks.constants.size() + 7 * 126);
        return unsound(blocks, near, 0);
    };
    for (const float count : {0.f, 7.f, 7 * 125.f}) CHECK(with_count(count).empty());
    for (const float count : {-7.f, 8.f, 7.5f, 7 * 126.f, 1e30f, std::numeric_limits<float>::quiet_NaN()})
        CHECK_FALSE(with_count(count).empty());
    Program cut;
    cut.constants = {1, 0.05f, 0.02f, 0.9f, 0, 14, 0, 0, 0, 0, 0, 0, 0};
    CHECK_FALSE(unsound(cut, near, 0).empty());
    cut.constants[5] = 7;
    CHECK(unsound(cut, near, 0).empty());
    cut.constants.resize(5);
    CHECK_FALSE(unsound(cut, near, 0).empty());
}

}  // namespace test_damaged_files
