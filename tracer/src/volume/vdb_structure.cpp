// The layout is that which OpenVDB's io/Archive.h, io/Compression.h and the readTopology() and readBuffers() of its
// tree's nodes read. All numbers are little-endian.
#include "volume/vdb_structure.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace phasetree::tracer {

namespace {

constexpr std::uint64_t magic = 0x56444220;
constexpr std::uint32_t oldest = 222;  // with compression by masks
constexpr std::uint64_t most_bytes = std::uint64_t{4} << 30;
constexpr std::uint32_t zip = 1, active_mask = 2, blosc = 4;  // a grid's compression

class Bytes {
  public:
    explicit Bytes(const std::filesystem::path& path) : in_(path, std::ios::binary) {
        std::error_code problem;
        if (!std::filesystem::exists(path, problem)) throw std::runtime_error("there is no such file");
        if (!std::filesystem::is_regular_file(path, problem) || !in_)
            throw std::runtime_error("it is not a file that can be read");
        size_ = std::filesystem::file_size(path);
    }
    std::uint64_t size() const { return size_; }
    std::uint64_t at() const { return at_; }
    void go_to(std::uint64_t at) {
        if (at > size_) cut_off();
        at_ = at;
        in_.seekg(static_cast<std::streamoff>(at));
    }
    void skip(std::uint64_t count) {
        if (count > size_ - at_) cut_off();
        // Few bytes are read, because seeking empties the stream's buffer.
        if (count <= 4096) {
            at_ += count;
            in_.ignore(static_cast<std::streamsize>(count));
        } else {
            go_to(at_ + count);
        }
    }
    template <class T>
    T number() {
        T n{};
        read(&n, sizeof n);
        return n;
    }
    template <class Words>
    void read_words(Words& words) {
        read(words.data(), words.size() * sizeof(words[0]));
    }
    std::string text() {
        const auto length = number<std::uint32_t>();
        if (length > size_ - at_) cut_off();
        if (length > 65536) throw std::runtime_error("it has a name that is too long");
        std::string text(length, ' ');
        read(text.data(), length);
        return text;
    }
    [[noreturn]] static void cut_off() { throw std::runtime_error("it is cut off, or damaged"); }

  private:
    void read(void* to, std::uint64_t count) {
        if (count > size_ - at_ || !in_.read(static_cast<char*>(to), static_cast<std::streamsize>(count))) cut_off();
        at_ += count;
    }

    std::ifstream in_;
    std::uint64_t size_ = 0, at_ = 0;
};

// How many bytes OpenVDB reads of a value of this type, whatever length the file gives it; nothing where it reads as
// many as the file says. Another length would let it go on at another place than this walk.
std::optional<std::uint32_t> metadata_bytes(const std::string& type) {
    if (type == "bool") return 1;
    for (const auto& [number, bytes] :
         {std::pair{"float", 4u}, std::pair{"double", 8u}, std::pair{"int32", 4u}, std::pair{"int64", 8u}})
        if (type == number) return bytes;
    for (const auto& [letter, bytes] : {std::pair{'i', 4u}, std::pair{'s', 4u}, std::pair{'d', 8u}}) {
        for (std::uint32_t n = 2; n <= 4; ++n)
            if (type == fmt::format("vec{}{}", n, letter)) return n * bytes;
        if (type == fmt::format("mat4{}", letter)) return 16 * bytes;
    }
    return std::nullopt;
}

// So many values as they are, or, behind a length that is not 0, packed by Blosc: a head of sixteen bytes, which has
// the unpacked and the packed length at its bytes 4 and 12, and the rest. Returns the bytes that were skipped.
std::uint64_t skip_packed(Bytes& file, std::uint32_t packed, std::uint64_t unpacked) {
    if (packed == 0) {
        file.skip(unpacked);
        return unpacked;
    }
    if (packed < 16) Bytes::cut_off();
    file.skip(4);
    if (file.number<std::uint32_t>() != unpacked) Bytes::cut_off();
    file.skip(4);
    if (file.number<std::uint32_t>() != packed) Bytes::cut_off();
    file.skip(packed - 16);
    return packed;
}

// What helps OpenVDB to read leaves later: of each a byte and, unless the length is the largest number, eight bytes.
void skip_delayed_load(Bytes& file, std::uint32_t bytes) {
    if (bytes == 0) return;
    const auto leaves = file.number<std::uint32_t>();
    // Each leaf takes 64 bytes of the file at least.
    if (leaves > file.size() / 64) Bytes::cut_off();
    std::uint64_t read = 12 + skip_packed(file, file.number<std::uint32_t>(), leaves);
    if (const auto packed = file.number<std::uint32_t>(); packed != 0xFFFFFFFF)
        read += skip_packed(file, packed, std::uint64_t{leaves} * 8);
    if (read != bytes) Bytes::cut_off();
}

// A list of names, types and values.
void skip_metadata(Bytes& file) {
    const auto count = file.number<std::uint32_t>();
    for (std::uint32_t i = 0; i < count; ++i) {
        file.text();
        const std::string type = file.text();
        const auto bytes = file.number<std::uint32_t>();
        if (type == "__delayedload") {
            skip_delayed_load(file, bytes);
            continue;
        }
        if (const auto known = metadata_bytes(type); known && bytes != *known) Bytes::cut_off();
        file.skip(bytes);
    }
}

// How many doubles tell of a transform of this type, if it is linear.
std::optional<std::uint64_t> doubles_of_linear_transform(const std::string& type) {
    const std::array<std::pair<const char*, std::uint64_t>, 7> doubles{{{"UniformScaleMap", 15},
                                                                        {"ScaleMap", 15},
                                                                        {"UniformScaleTranslateMap", 18},
                                                                        {"ScaleTranslateMap", 18},
                                                                        {"TranslationMap", 3},
                                                                        {"AffineMap", 16},
                                                                        {"UnitaryMap", 16}}};
    for (const auto& [name, count] : doubles)
        if (type == name) return count;
    return std::nullopt;
}

void skip_transform(Bytes& file) {
    std::string type = file.text();
    if (type == "NonlinearFrustumMap") {
        // A box, a taper and a depth, and the transform that comes after it. OpenVDB follows one within another to any
        // depth; nobody writes one that is not linear.
        file.skip(8 * 8);
        type = file.text();
    }
    const auto doubles = doubles_of_linear_transform(type);
    if (!doubles) throw std::runtime_error("its voxels are not of one size");
    file.skip(8 * *doubles);
}

// A mask of the 2^(3 log2) places of a node.
struct Mask {
    std::vector<std::uint64_t> words;

    Mask(Bytes& file, unsigned log2) : words((std::size_t{1} << (3 * log2)) / 64) { file.read_words(words); }
    std::uint64_t count() const {
        std::uint64_t on = 0;
        for (const std::uint64_t w : words) on += static_cast<std::uint64_t>(std::popcount(w));
        return on;
    }
};

// One grid's tree: a root, nodes of 32³ and of 16³ places, and leaves of 8³.
class TreeWalk {
  public:
    TreeWalk(Bytes& file, std::uint32_t compression, unsigned value_bytes, unsigned stored_bytes)
        : file_(file), compression_(compression), value_bytes_(value_bytes), stored_bytes_(stored_bytes) {}

    void operator()() {
        file_.skip(4);             // the number of buffers, once
        file_.skip(value_bytes_);  // the background
        const auto tiles = file_.number<std::uint32_t>(), children = file_.number<std::uint32_t>();
        file_.skip(std::uint64_t{tiles} * (13 + value_bytes_));
        // Each takes more than a thousand bytes.
        if (children > file_.size() / 1024) Bytes::cut_off();
        pay(std::uint64_t{tiles} * 96);
        for (std::uint32_t i = 0; i < children; ++i) {
            file_.skip(12);
            node(5);
        }
        for (; leaves_ > 0; --leaves_) values(Mask(file_, 3), 3);
    }

  private:
    void node(unsigned log2) {
        if (log2 == 3) {
            file_.skip(64);
            ++leaves_;
            return pay(512 * std::uint64_t{value_bytes_} + 128);
        }
        const Mask has_child(file_, log2), is_active(file_, log2);
        pay((std::uint64_t{1} << (3 * log2)) * 8);
        values(is_active, log2);
        const std::uint64_t children = has_child.count();
        for (std::uint64_t i = 0; i < children; ++i) node(log2 - 1);
    }
    // The values of a node: how inactive ones are stored, these, and the rest, which may be compressed.
    void values(const Mask& is_active, unsigned log2) {
        const std::uint64_t places = std::uint64_t{1} << (3 * log2);
        const auto how = file_.number<std::int8_t>();
        if (how < 0 || how > 6) Bytes::cut_off();
        if (how == 2 || how == 4 || how == 5) file_.skip(value_bytes_);
        if (how == 5) file_.skip(value_bytes_);
        if (how >= 3 && how <= 5) file_.skip(places / 8);
        const bool is_short = (compression_ & active_mask) != 0 && how != 6;
        const std::uint64_t bytes = (is_short ? is_active.count() : places) * stored_bytes_;
        // Of halves none are read if there are none.
        if (bytes == 0 && stored_bytes_ != value_bytes_) return;
        if ((compression_ & (zip | blosc)) == 0) return file_.skip(bytes);
        const auto packed = file_.number<std::int64_t>();
        if (packed > 0) return file_.skip(static_cast<std::uint64_t>(packed));
        // A number that is not above zero says that the bytes are there as they are, and minus how many.
        if (0 - static_cast<std::uint64_t>(packed) != bytes) Bytes::cut_off();
        file_.skip(bytes);
    }
    void pay(std::uint64_t bytes) {
        paid_ += bytes;
        if (paid_ > most_bytes)
            throw std::runtime_error(fmt::format("one of its grids takes more than {} GB of memory", most_bytes >> 30));
    }

    Bytes& file_;
    std::uint32_t compression_;
    unsigned value_bytes_, stored_bytes_;
    std::uint64_t leaves_ = 0, paid_ = 0;
};

// How many bytes a value of a grid of this type has; nothing if the type is none that is read.
std::optional<unsigned> value_bytes_of(const std::string& type) {
    for (const auto& [name, bytes] :
         {std::pair{"float", 4u}, std::pair{"double", 8u}, std::pair{"int32", 4u}, std::pair{"int64", 8u}})
        if (type == fmt::format("Tree_{}_5_4_3", name)) return bytes;
    return std::nullopt;
}

void check_grid(Bytes& file, std::string type, bool is_instance) {
    const std::string half = "_HalfFloat";
    const bool is_half = type.ends_with(half);
    if (is_half) type.resize(type.size() - half.size());
    const auto compression = file.number<std::uint32_t>();
    skip_metadata(file);
    skip_transform(file);
    const std::optional<unsigned> bytes = value_bytes_of(type);
    if (bytes && !is_instance) TreeWalk(file, compression, *bytes, is_half ? 2 : *bytes)();
}

}  // namespace

void check_vdb_structure(const std::filesystem::path& path) {
    Bytes file(path);
    if (file.size() < 8 || file.number<std::uint64_t>() != magic) throw std::runtime_error("it is no OpenVDB file");
    const auto version = file.number<std::uint32_t>();
    if (version < oldest)
        throw std::runtime_error("it is of a version of OpenVDB before 1.1; save it again with a later one");
    file.skip(8);
    if (file.number<std::int8_t>() == 0)
        throw std::runtime_error("it is a stream, which does not say where its grids are");
    file.skip(36);
    skip_metadata(file);
    const auto grids = file.number<std::int32_t>();
    if (grids < 0) Bytes::cut_off();
    for (std::int32_t i = 0; i < grids; ++i) {
        file.text();
        const std::string type = file.text();
        const bool is_instance = !file.text().empty();
        const auto grid = file.number<std::int64_t>();
        file.skip(8);
        const auto end = file.number<std::int64_t>();
        // Each grid lies behind what tells of it, and the next one behind it, so that nothing is walked through twice.
        if (grid < 0 || static_cast<std::uint64_t>(grid) < file.at()) Bytes::cut_off();
        file.go_to(static_cast<std::uint64_t>(grid));
        check_grid(file, type, is_instance);
        if (end < 0 || static_cast<std::uint64_t>(end) < file.at()) Bytes::cut_off();
        file.go_to(static_cast<std::uint64_t>(end));
    }
}

}  // namespace phasetree::tracer
