/// A file of cells: a header, and behind it the tables one after another, in the machine's own byte order.
///
/// What differs from machine to machine or from version to version is in the header, so that nothing else needs to be
/// converted. The object's program is not in the file. It is recorded anew, which takes no time beside what cells take,
/// and its fingerprint must be the one that the cells were built for.

#include "cells/file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

#include "cells/file_header.hpp"
#include "cells/sound.hpp"
#include "files/regular_file.hpp"
#include "files/whole_file.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/version.hpp"
#include "program/fused.hpp"

namespace phasetree {

using building::RoutineTables;
using cells::CellsFile, cells::CellsFileHeader, cells::CellsMade, cells::CellTables, cells::Checksum,
    cells::InterfaceCell, cells::what_is_unsound;
using files::FileError, files::RegularFile, files::WholeFile;
using kernel::few_slots, kernel::LinearBound, kernel::most_certificate_steps, kernel::OutputSlot,
    kernel::PackedCertificateStep, kernel::Step;
using program::first_placed, program::placed_floats;

namespace {

namespace fs = std::filesystem;
using Reason = CellsFileError::Reason;
using Header = CellsFileHeader;
using enum CellsFileHeader::Section;
constexpr std::size_t section_count = CellsFileHeader::sections;

/// A cell without the gaps between its members, whose bits are nobody's.
struct StoredCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;
    std::uint8_t curvature, other_curvature, first_phase, flags;
    std::uint32_t unused;

    static constexpr unsigned by_own = 1, by_first = 2;

    static StoredCell of(const InterfaceCell& c) {
        return {c.box,
                c.bound,
                c.shape,
                c.first_data,
                c.curvature,
                c.other_curvature,
                c.first_phase,
                static_cast<std::uint8_t>((c.is_by_own ? by_own : 0) | (c.is_by_first ? by_first : 0)),
                0};
    }
    InterfaceCell cell() const {
        return {box,
                bound,
                shape,
                first_data,
                curvature,
                other_curvature,
                first_phase,
                (flags & by_own) != 0,
                (flags & by_first) != 0};
    }
};
static_assert(sizeof(StoredCell) == 64 && sizeof(Step) == 16 && sizeof(OutputSlot) == 12 &&
              sizeof(PackedCertificateStep) == 16 && sizeof(RoutineTables::Shape) == 24);
constexpr std::array<std::uint64_t, section_count> item_bytes{
    sizeof(StoredCell),    sizeof(RoutineTables::Shape),  sizeof(Step),          sizeof(OutputSlot),
    sizeof(std::uint32_t), sizeof(PackedCertificateStep), sizeof(std::uint32_t), sizeof(float)};

std::array<char, 24> as_chars(std::string_view text) {
    std::array<char, 24> chars{};
    std::copy_n(text.begin(), std::min(text.size(), chars.size() - 1), chars.begin());
    return chars;
}
std::string as_text(const std::array<char, 24>& chars) {
    std::string text;
    for (const char c : chars) {
        if (c == '\0') break;
        text += c >= ' ' && c < '\x7f' ? c : '?';
    }
    return text;
}

/// The kind of machine. Its instruction set is not in it: tables are the same with any.
std::string_view machine() {
#if defined(__x86_64__)
    return "x86-64";
#elif defined(__aarch64__)
    return "aarch64";
#else
    return "another 64-bit machine";
#endif
}

/// What steps and registers mean: the list of operations, with how many floats each takes.
std::uint64_t layout_of_tables() {
    Checksum sum;
    const auto put = [&](std::uint64_t n) { sum.put(&n, sizeof n); };
    for (const std::size_t n :
         {batch_size, std::size_t{few_slots}, most_certificate_steps, placed_floats, std::size_t{first_placed}})
        put(n);
    const auto put_type = [&]<class T>() {
        put(sizeof(T));
        if constexpr (requires { T::info.name; }) sum.put(T::info.name.data(), T::info.name.size());
    };
    for_each_type(Primitives(), put_type);
    for_each_type(DataPrimitives(), put_type);
    for_each_type(PointMaps(), put_type);
    return sum.get();
}

/// Of an object as it was recorded; of the constants only its own.
std::uint64_t fingerprint(const Program& program, std::size_t own_constants) {
    Checksum sum;
    for (const Instruction& in : program.instructions) {
        const std::array<std::uint32_t, 4> words{static_cast<std::uint32_t>(in.op), in.a, in.b, in.data};
        sum.put(words.data(), sizeof words);
    }
    for (const Output& o : program.outputs) {
        const std::array<std::uint32_t, 2> words{o.phase.index, o.value};
        sum.put(words.data(), sizeof words);
    }
    sum.put(program.constants.data(), own_constants * sizeof(float));
    sum.put(program.lipschitz.data(), program.lipschitz.size() * sizeof(float));
    return sum.get();
}

Header header_of(const Program& program, std::size_t own_constants, const CellsMade& made) {
    Header h{};
    h.magic = Header::known_magic;
    h.format = Header::known_format;
    h.byte_order = Header::own_byte_order;
    h.library = as_chars(version());
    h.machine = as_chars(machine());
    h.layout = layout_of_tables();
    h.program = fingerprint(program, own_constants);
    h.opaque = made.opaque.bits;
    h.most_bytes = made.most_bytes;
    h.resolution = made.resolution;
    h.deepest = made.deepest;
    h.quality = static_cast<std::uint32_t>(made.quality);
    return h;
}

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& items) {
    return std::as_bytes(std::span(items));
}

class Reading {
  public:
    explicit Reading(const fs::path& path) : path_(path), file_(open(path)) {}

    CellTables operator()(Program& program, const CellsMade& made) {
        const Header h = header();
        const Header wanted = header_of(program, program.constants.size(), made);
        require_same(h, wanted);
        require_size(h);
        CellTables t;
        t.recorded_constants = program.constants.size();
        t.routine_count = h.routines;
        t.is_coarser = h.is_coarser != 0;
        read(t.cells, h.counts[cells]);
        read(t.routines.shapes, h.counts[shapes]);
        read(t.routines.steps, h.counts[steps]);
        read(t.routines.outputs, h.counts[outputs]);
        read(t.routines.data, h.counts[data]);
        read(t.certificates, h.counts[certificates]);
        read(t.first_certificate, h.counts[first_certificates]);
        std::vector<float> more;
        read(more, h.counts[constants]);
        if (sum_.get() != h.tables_checksum)
            throw error(Reason::damaged, "it is damaged: its checksum is not that of its contents");
        program.constants.insert(program.constants.end(), more.begin(), more.end());
        if (const std::string wrong = what_is_unsound(t, program); !wrong.empty())
            throw error(Reason::damaged, "it is damaged: " + wrong);
        return t;
    }

  private:
    CellsFileError error(Reason reason, const std::string& what) const { return {reason, path_, what}; }

    static RegularFile open(const fs::path& path) {
        try {
            return RegularFile(path);
        } catch (const FileError& e) {
            throw CellsFileError(e.is_missing() ? Reason::missing : Reason::unusable, path, e.what());
        }
    }
    void read_bytes(void* to, std::size_t count) {
        try {
            if (!file_.read(to, count)) throw error(Reason::damaged, "it is damaged: it ends too early");
        } catch (const FileError& e) {
            throw error(Reason::unusable, e.what());
        }
    }
    template <class T>
    void read(std::vector<T>& items, std::uint64_t count) {
        items.resize(count);
        read_bytes(items.data(), count * sizeof(T));
        sum_.put(items.data(), count * sizeof(T));
    }
    void read(std::vector<InterfaceCell>& cells, std::uint64_t count) {
        std::vector<StoredCell> stored;
        read(stored, count);
        cells.reserve(count);
        for (const StoredCell& s : stored) cells.push_back(s.cell());
    }

    Header header() {
        Header h{};
        if (file_.size() < sizeof h) {
            decltype(Header::magic) start{};
            if (file_.size() >= start.size()) read_bytes(start.data(), start.size());
            if (start == Header::known_magic) throw error(Reason::damaged, "it is damaged: it ends too early");
            throw error(Reason::foreign, "it is no file of cells");
        }
        read_bytes(&h, sizeof h);
        if (h.magic != Header::known_magic) throw error(Reason::foreign, "it is no file of cells");
        if (h.byte_order != Header::own_byte_order) {
            if (h.byte_order != Header::other_byte_order)
                throw error(Reason::damaged, "it is damaged: its header is wrong");
            throw error(Reason::differing, "it was written by a machine of the other byte order");
        }
        if (h.format != Header::known_format)
            throw error(Reason::differing, fmt::format("its format is version {}, and this library reads version {}",
                                                       h.format, Header::known_format));
        if (h.header_checksum != h.own_checksum())
            throw error(Reason::damaged, "it is damaged: its header's checksum is wrong");
        return h;
    }

    /// `h` is that of the file.
    void require_same(const Header& h, const Header& wanted) const {
        const auto differs = [&](const std::string& what) { return error(Reason::differing, what); };
        if (h.library != wanted.library)
            throw differs(fmt::format("it was written by version {} of the library, and this is {}", as_text(h.library),
                                      as_text(wanted.library)));
        if (h.machine != wanted.machine)
            throw differs(fmt::format("it was written for {}, and this is {}", as_text(h.machine), machine()));
        if (h.layout != wanted.layout) throw differs("it was written by a library with other nodes");
        if (h.program != wanted.program) throw differs("its cells are those of another tree");
        if (h.resolution != wanted.resolution)
            throw differs(
                fmt::format("its cells have the resolution {}, and wanted is {}", h.resolution, wanted.resolution));
        if (h.quality != wanted.quality) throw differs("its cells were built with another quality");
        if (h.deepest != wanted.deepest)
            throw differs(
                fmt::format("its cells were built with {} divisions, and wanted are {}", h.deepest, wanted.deepest));
        if (h.opaque != wanted.opaque) throw differs("its cells were built with other phases opaque");
        // Cells that are not coarser for want of memory are those that any more of it gives.
        if (h.is_coarser ? h.most_bytes != wanted.most_bytes : h.most_bytes > wanted.most_bytes)
            throw differs("its cells were built with another limit of memory");
    }

    /// So that nothing is allocated that the file does not have.
    void require_size(const Header& h) const {
        std::uint64_t left = file_.size() - sizeof(Header);
        for (std::size_t i = 0; i < section_count; ++i) {
            if (h.counts[i] > left / item_bytes[i] || h.counts[i] > 0xffffffffu)
                throw error(Reason::damaged, "it is damaged: it ends too early");
            left -= h.counts[i] * item_bytes[i];
        }
        if (left != 0) throw error(Reason::damaged, "it is damaged: something is behind its end");
    }

    const fs::path& path_;
    RegularFile file_;
    Checksum sum_;
};

}  // namespace

CellsFileError::CellsFileError(Reason reason, const fs::path& path, const std::string& what)
    : std::runtime_error(fmt::format("cells' file \"{}\": {}", path.string(), what)), reason_(reason) {}

void write_cells(const fs::path& path, const InterfaceCells& cells) {
    const auto [t, program, made] = CellsFile::contents(cells);
    std::vector<StoredCell> stored;
    stored.reserve(t.cells.size());
    for (const InterfaceCell& c : t.cells) stored.push_back(StoredCell::of(c));
    const auto more = std::as_bytes(std::span(program.constants).subspan(t.recorded_constants));
    Header h = header_of(program, t.recorded_constants, made);
    h.is_coarser = t.is_coarser;
    h.routines = t.routine_count;
    const std::array<std::span<const std::byte>, section_count> parts{bytes_of(stored),
                                                                      bytes_of(t.routines.shapes),
                                                                      bytes_of(t.routines.steps),
                                                                      bytes_of(t.routines.outputs),
                                                                      bytes_of(t.routines.data),
                                                                      bytes_of(t.certificates),
                                                                      bytes_of(t.first_certificate),
                                                                      more};
    Checksum sum;
    for (std::size_t i = 0; i < section_count; ++i) {
        h.counts[i] = parts[i].size() / item_bytes[i];
        sum.put(parts[i].data(), parts[i].size());
    }
    h.tables_checksum = sum.get();
    h.header_checksum = h.own_checksum();
    try {
        WholeFile file(path);
        file.write(std::as_bytes(std::span(&h, 1)));
        for (const auto& part : parts) file.write(part);
        file.finish();
    } catch (const FileError& e) {
        throw CellsFileError(Reason::unusable, path, e.what());
    }
}

std::shared_ptr<const InterfaceCells> read_cells(const fs::path& path, const Phased& object,
                                                 const CellOptions& options) {
    Reading reading(path);
    return CellsFile::read(object, options, std::ref(reading));
}

}  // namespace phasetree
