#include <fmt/format.h>

#include "cells/file_format.hpp"
#include "cells/validate.hpp"
#include "files/regular_file.hpp"
#include "phasetree/cells/file.hpp"

namespace phasetree {

using cells::as_text, cells::describe_damage, cells::header_of, cells::item_bytes, cells::machine;
using cells::BuildSettings, cells::CellsFile, cells::CellsFileHeader, cells::CellTables, cells::Checksum,
    cells::InterfaceCell, cells::StoredCell;
using files::FileError, files::RegularFile;

namespace {

namespace fs = std::filesystem;
using Reason = CellsFileError::Reason;
using Header = CellsFileHeader;

// Reads one file.
class CellsReader {
  public:
    explicit CellsReader(const fs::path& path) : path_(path), file_(open(path)) {}

    // Returns the tables if the file matches the program and the settings. Appends the constants of the cells to those
    // of the program.
    CellTables read(Program& program, const BuildSettings& settings) {
        const Header h = header();
        const Header wanted = header_of(program, program.constants.size(), settings);
        require_same(h, wanted);
        require_size(h);
        using enum CellsFileHeader::Section;
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
        read(t.faces, h.counts[faces]);
        read(t.first_faces, h.counts[first_faces]);
        std::vector<float> added;
        read(added, h.counts[constants]);
        if (sum_.get() != h.tables_checksum)
            throw error(Reason::damaged, "it is damaged: its checksum does not match its contents");
        program.constants.insert(program.constants.end(), added.begin(), added.end());
        if (const std::string wrong = describe_damage(t, program); !wrong.empty())
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
            throw error(Reason::foreign, "it is not a cell file");
        }
        read_bytes(&h, sizeof h);
        if (h.magic != Header::known_magic) throw error(Reason::foreign, "it is not a cell file");
        if (h.byte_order != Header::own_byte_order) {
            if (h.byte_order != Header::other_byte_order)
                throw error(Reason::damaged, "it is damaged: its header is wrong");
            throw error(Reason::differing, "it was written by a machine with another byte order");
        }
        if (h.format != Header::known_format)
            throw error(Reason::differing, fmt::format("its format is version {}, and this library reads version {}",
                                                       h.format, Header::known_format));
        if (h.header_checksum != h.own_checksum())
            throw error(Reason::damaged, "it is damaged: its header's checksum is wrong");
        return h;
    }

    // Requires that the file's header `h` matches `wanted`.
    void require_same(const Header& h, const Header& wanted) const {
        const auto differs = [&](const std::string& what) { return error(Reason::differing, what); };
        if (h.library != wanted.library)
            throw differs(fmt::format("it was written by build {}, but this is build {}; write the cells again",
                                      as_text(h.library), as_text(wanted.library)));
        if (h.machine != wanted.machine)
            throw differs(fmt::format("it was written for {}, but this is {}", as_text(h.machine), machine()));
        if (h.layout != wanted.layout)
            throw differs(
                "it was written by a build of the library with a different list of nodes; write the cells again");
        if (h.program != wanted.program) throw differs("its cells belong to another tree");
        if (h.resolution != wanted.resolution)
            throw differs(fmt::format("its cells have resolution {}, not {}", h.resolution, wanted.resolution));
        if (h.quality != wanted.quality) throw differs("its cells were built with another quality");
        if (h.max_depth != wanted.max_depth)
            throw differs(
                fmt::format("its cells were built with at most {} divisions, not {}", h.max_depth, wanted.max_depth));
        if (h.opaque != wanted.opaque) throw differs("its cells were built with other phases opaque");
        // If the cells are not coarser, the limit had no effect, and any higher limit gives the same cells.
        if (h.is_coarser ? h.max_bytes != wanted.max_bytes : h.max_bytes > wanted.max_bytes)
            throw differs("its cells were built with another memory limit");
    }

    // Requires that the file has the size implied by its header, before memory is allocated.
    void require_size(const Header& h) const {
        std::uint64_t rest = file_.size() - sizeof(Header);
        for (std::size_t i = 0; i < CellsFileHeader::sections; ++i) {
            if (h.counts[i] > rest / item_bytes[i] || h.counts[i] > 0xffffffffu)
                throw error(Reason::damaged, "it is damaged: it ends too early");
            rest -= h.counts[i] * item_bytes[i];
        }
        if (rest != 0) throw error(Reason::damaged, "it is damaged: it is longer than its header says");
    }

    const fs::path& path_;
    RegularFile file_;
    Checksum sum_;
};

}  // namespace

std::shared_ptr<const InterfaceCells> read_cells(const fs::path& path, const Phased& object,
                                                 const CellOptions& options) {
    CellsReader reader(path);
    return CellsFile::read(object, options, [&](Program& program, const BuildSettings& settings) {
        return reader.read(program, settings);
    });
}

}  // namespace phasetree
