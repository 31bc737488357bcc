// Files of cells: what is read is what was built, and whatever is done to a file is refused or harmless.
#include "cells/file_header.hpp"
#include "cells/sound.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/model/ray.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>

using namespace phasetree;
using namespace phasetree::tests;

using cells::CellsFileHeader, cells::CellTables, cells::Checksum, cells::InterfaceCell, cells::what_is_unsound;

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;
using Reason = CellsFileError::Reason;

bool is_long() {
    const char* const value = std::getenv("PHASETREE_LONG_TESTS");
    return value && *value == '1';
}

// A folder of the test's own, gone behind it.
class Folder {
  public:
    Folder() {
        std::string name = (fs::temp_directory_path() / "phasetree-cells-XXXXXX").string();
        REQUIRE(::mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    fs::path operator/(const char* name) const { return path_ / name; }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
    }

  private:
    fs::path path_;
};

Bytes bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}
void put(const fs::path& path, const Bytes& bytes) {
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    REQUIRE(out.good());
}

// Long and short primitives, one with data, blocks whose sites are listed for each cell, a warp, four phases.
Phased various() {
    return read_tree(Document::from_text(R"({
        "phases": {"wall": 0, "prism": 0, "shell": 0, "core": 0},
        "tree": {"under": [
            {"set": {"phase": "wall", "of": {"intersection": {"of": [
                {"voronoi_cells": {"size": 0.5, "gap": 0.05, "rounding": 0.02}}, {"box": {"size": [1, 1, 1]}}]}}}},
            {"set": {"phase": "prism", "of": {"smooth_union": {"radius": 0.2, "of": [
                {"extrude": {"height": 0.6, "of": {"polygon": {"points": [[-1, -1], [1, -1], [0.2, 0.9]]}}}},
                {"twist": {"rate": 20, "of": {"torus": {"major": 0.8, "minor": 0.2}}}}]}}}},
            {"thin_shell": {"of": {"sphere": {"radius": 0.7}}, "shell": "shell", "inside": "core",
                            "half_thickness": 0.05}}]}})"))
        .object;
}

const CellOptions few{.deepest = 3};

std::optional<Crossing> nearest(const InterfaceCells& cells, const glm::vec3& from, const glm::vec3& direction) {
    std::optional<Crossing> hit;
    TraceCounters counters;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const auto one =
            cells.first_crossing(c, TracedRay(from, direction), 0, hit ? hit->t_in : 10.f, std::nullopt, {}, counters);
        if (one && (!hit || one->t_in < hit->t_in)) hit = one;
    }
    return hit;
}

bool are_equal(const CrossingNormal& a, const CrossingNormal& b) {
    return a.unit == b.unit && a.gradient == b.gradient;
}

int differing_cells(const InterfaceCells& a, const InterfaceCells& b) {
    REQUIRE(a.size() == b.size());
    Random rng(7);
    TraceCounters counted_a, counted_b;
    int differing = 0, crossings = 0;
    for (std::size_t c = 0; c < a.size(); ++c) {
        const Bounds box = a.bounds(c);
        if (box.low != b.bounds(c).low || box.high != b.bounds(c).high) ++differing;
        for (int i = 0; i < 4; ++i) {
            const glm::vec3 d = rng.direction(), o = box.centre() - 2 * box.diagonal() * d;
            const TracedRay ray(o, d);
            const auto x = a.first_crossing(c, ray, 0, 100, {}, {}, counted_a);
            const auto y = b.first_crossing(c, ray, 0, 100, {}, {}, counted_b);
            if (x.has_value() != y.has_value()) ++differing;
            if (!x || !y) continue;
            ++crossings;
            if (x->t_in != y->t_in || x->t_out != y->t_out || x->p_in != y->p_in || x->from != y->from ||
                x->to != y->to)
                ++differing;
            if (!are_equal(a.normal(c, *x, d), b.normal(c, *y, d))) ++differing;
        }
    }
    CHECK(counted_a.batches == counted_b.batches);
    CHECK(crossings > static_cast<int>(a.size()) / 4);
    return differing;
}

// Why a file is refused; nothing if it is not.
std::optional<Reason> refusal(const fs::path& path, const Phased& object, const CellOptions& options = few,
                              std::string* message = nullptr) {
    try {
        (void)read_cells(path, object, options);
    } catch (const CellsFileError& e) {
        if (message) *message = e.what();
        CHECK(std::string(e.what()).find(path.string()) != std::string::npos);
        return e.reason();
    }
    return std::nullopt;
}

CellsFileHeader header_of(const Bytes& file) {
    CellsFileHeader h;
    REQUIRE(file.size() >= sizeof h);
    std::memcpy(&h, file.data(), sizeof h);
    return h;
}
void set_header(Bytes& file, CellsFileHeader h) {
    h.header_checksum = h.own_checksum();
    std::memcpy(file.data(), &h, sizeof h);
}
// Makes a changed file's checksums right.
void forge(Bytes& file) {
    CellsFileHeader h = header_of(file);
    constexpr std::array<std::size_t, CellsFileHeader::sections> size{64, 24, 16, 12, 4, 16, 4, 4};
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

struct Written {
    explicit Written(const CellOptions& with = few) : object(various()), cells(object, with), path(folder / "cells") {
        write_cells(path, cells);
        bytes = bytes_of(path);
    }
    Folder folder;
    Phased object;
    InterfaceCells cells;
    fs::path path;
    Bytes bytes;
};

}  // namespace

TEST_CASE("cells from a file are those that were written") {
    for (const CellOptions& options :
         {CellOptions{}, few, CellOptions{.quality = BuildQuality::low, .opaque = {0b10110}}}) {
        const Written w(options);
        const auto read = read_cells(w.path, w.object, options);
        CHECK(differing_cells(w.cells, *read) == 0);
        const CellStatistics a = w.cells.statistics(), b = read->statistics();
        CHECK(a.bytes == b.bytes);
        CHECK(a.routines == b.routines);
        CHECK(a.median_instructions == b.median_instructions);
        CHECK(read->resolution() == w.cells.resolution());
        CHECK(read->reach() == w.cells.reach());
        CHECK(read->opaque() == w.cells.opaque());
        // And written again they are the same file.
        write_cells(w.folder / "again", *read);
        CHECK(bytes_of(w.folder / "again") == w.bytes);
        CHECK(w.folder.files() == 2);
    }
}

TEST_CASE("random trees come back from files") {
    Random rng(17);
    const Folder folder;
    int read = 0;
    for (int i = 0; i < 40; ++i) {
        const Phased object = random_object(rng, 3);
        try {
            const InterfaceCells cells(object, few);
            write_cells(folder / "cells", cells);
            if (cells.size() == 0) continue;
            ++read;
            const auto again = read_cells(folder / "cells", object, few);
            CHECK(again->size() == cells.size());
            write_cells(folder / "again", *again);
            CHECK(bytes_of(folder / "cells") == bytes_of(folder / "again"));
        } catch (const ModelError&) {
        }
    }
    CHECK(read > 20);
}

TEST_CASE("every instruction set writes the same file") {
    const std::string usual = simd_target();
    std::optional<Bytes> first;
    for (const std::string& name : simd_targets()) {
        use_simd_target(name);
        const Written w;
        if (!first) first = w.bytes;
        CHECK(w.bytes == *first);
    }
    use_simd_target(usual);
}

TEST_CASE("a file of other cells is refused, and says in what it differs") {
    const Written w;
    std::string message;
    const auto expect = [&](const Phased& object, const CellOptions& options, const char* part) {
        CHECK(refusal(w.path, object, options, &message) == Reason::differing);
        CAPTURE(message);
        CHECK(message.find(part) != std::string::npos);
    };
    CHECK_FALSE(refusal(w.path, w.object, few));
    expect(Set{.phase = Phase{1}, .of = Sphere{.radius = 1}}, few, "another tree");
    expect(w.object, {}, "divisions");
    expect(w.object, {.deepest = 3, .quality = BuildQuality::low}, "quality");
    expect(w.object, {.deepest = 3, .opaque = {0b10}}, "opaque");
    expect(w.object, {.resolution = 1e-4f, .deepest = 3}, "resolution");

    const auto with = [&](auto&& change, const char* part) {
        Bytes file = w.bytes;
        CellsFileHeader h = header_of(file);
        change(h);
        set_header(file, h);
        put(w.folder / "other", file);
        CHECK(refusal(w.folder / "other", w.object, few, &message) == Reason::differing);
        CAPTURE(message);
        CHECK(message.find(part) != std::string::npos);
    };
    with([](CellsFileHeader& h) { h.library = {'9', '.', '9', '\n'}; }, "version 9.9? of the library");
    with([](CellsFileHeader& h) { h.machine = {'p', 'd', 'p', '1', '1'}; }, "written for pdp11");
    with([](CellsFileHeader& h) { h.layout += 1; }, "other nodes");
    with([](CellsFileHeader& h) { h.format += 1; }, "format is version 2");
    with([](CellsFileHeader& h) { h.byte_order = 0x04030201; }, "byte order");
}

TEST_CASE("cells that have all the memory they want are those that more of it gives; others are not") {
    const CellOptions roomy{.most_bytes = 1 << 28}, tight{.most_bytes = 1 << 18};
    const auto with = [](std::size_t bytes) { return CellOptions{.most_bytes = bytes}; };
    const Written all(roomy), less(tight);
    REQUIRE_FALSE(all.cells.statistics().is_coarser);
    REQUIRE(less.cells.statistics().is_coarser);
    CHECK_FALSE(refusal(all.path, all.object, roomy));
    CHECK_FALSE(refusal(all.path, all.object, with(1 << 29)));
    CHECK(refusal(all.path, all.object, with((1 << 28) - 1)) == Reason::differing);
    CHECK_FALSE(refusal(less.path, less.object, tight));
    CHECK(read_cells(less.path, less.object, tight)->statistics().is_coarser);
    for (const std::size_t bytes : {(1 << 18) + 1, (1 << 18) - 1, 1 << 28})
        CHECK(refusal(less.path, less.object, with(bytes)) == Reason::differing);
}

TEST_CASE("what is no file of cells") {
    const Written w;
    CHECK(refusal(w.folder / "nothing", w.object) == Reason::missing);
    CHECK(refusal(w.folder / "cells/below", w.object) == Reason::missing);
    CHECK(refusal(w.folder / ".", w.object) == Reason::unusable);
    CHECK(refusal("/dev/zero", w.object) == Reason::unusable);
    REQUIRE(::mkfifo((w.folder / "pipe").c_str(), 0600) == 0);
    CHECK(refusal(w.folder / "pipe", w.object) == Reason::unusable);
    put(w.folder / "empty", {});
    CHECK(refusal(w.folder / "empty", w.object) == Reason::foreign);
    put(w.folder / "text", Bytes(5000, 'x'));
    CHECK(refusal(w.folder / "text", w.object) == Reason::foreign);
    Bytes more = w.bytes;
    more.push_back(0);
    put(w.folder / "more", more);
    CHECK(refusal(w.folder / "more", w.object) == Reason::damaged);
}

TEST_CASE("a file that ends too early is refused wherever it ends") {
    const Written w;
    const std::size_t step = is_long() ? 1 : 1 + w.bytes.size() / 4000;
    const fs::path path = w.folder / "short";
    for (std::size_t size = w.bytes.size(); size-- > 0; size -= std::min(size, step - 1)) {
        put(path, Bytes(w.bytes.begin(), w.bytes.begin() + static_cast<std::ptrdiff_t>(size)));
        CAPTURE(size);
        REQUIRE(refusal(path, w.object) == (size < 8 ? Reason::foreign : Reason::damaged));
    }
}

TEST_CASE("a changed byte is found, every one of them") {
    const Written w;
    MESSAGE(w.bytes.size(), " bytes");
    Random rng(23);
    const fs::path path = w.folder / "changed";
    const std::size_t step = is_long() ? 1 : 1 + w.bytes.size() / 8000;
    for (std::size_t at = 0; at < w.bytes.size(); at += at < sizeof(CellsFileHeader) ? 1 : step) {
        Bytes file = w.bytes;
        file[at] ^= static_cast<unsigned char>(1 << rng.below(8));
        put(path, file);
        CAPTURE(at);
        REQUIRE(refusal(path, w.object));
    }
}

TEST_CASE("no counts make more be allocated than the file has") {
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
    const int count = is_long() ? 200'000 : 4'000;
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
    t.routines.shapes = {{.first_step = 0, .steps = 1, .leading = 0, .first_output = 0, .outputs = 1, .slots = 4}};
    t.routines.steps = {{.op = op, .to = 3, .a = 0, .b = 0}};
    t.routines.outputs = {{.slot = 3, .phase = 1, .sign = 1}};
    t.routines.data = {data};
    t.cells = {InterfaceCell{}};
    t.first_certificate = {0, 0};
    return what_is_unsound(t, program);
}

}  // namespace

TEST_CASE("a primitive with data takes none but its own of the object, or a list that is all there") {
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

TEST_CASE("a file that cannot be written leaves nothing behind") {
    const Written w;
    const auto reason = [&](const fs::path& path) -> std::optional<Reason> {
        try {
            write_cells(path, w.cells);
        } catch (const CellsFileError& e) {
            return e.reason();
        }
        return std::nullopt;
    };
    CHECK(reason(w.folder / "no/such/folder") == Reason::unusable);
    CHECK(reason(w.folder / ".") == Reason::unusable);
    CHECK(reason("/dev/null") == Reason::unusable);
    // No room for all of it, as on a full disk.
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit little{20000, before.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &little) == 0);
    const auto full = reason(w.path), full_elsewhere = reason(w.folder / "other");
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(full == Reason::unusable);
    CHECK(full_elsewhere == Reason::unusable);
    CHECK(w.folder.files() == 1);
    CHECK(bytes_of(w.path) == w.bytes);
    fs::create_symlink(w.path, w.folder / "link");
    put(w.path, {});
    CHECK_FALSE(reason(w.folder / "link"));
    CHECK(fs::is_symlink(w.folder / "link"));
    CHECK(bytes_of(w.path) == w.bytes);
}
