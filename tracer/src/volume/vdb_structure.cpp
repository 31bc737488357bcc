// The layout is the one read by OpenVDB's io/Archive.h, io/Compression.h and the readTopology() and readBuffers() of
// its tree nodes. All numbers are little-endian.
#include "volume/vdb_structure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace phasetree::tracer {

namespace {

constexpr std::uint64_t magic = 0x56444220;
constexpr std::uint32_t oldest = 222;  // has compression by masks
constexpr std::uint64_t max_bytes = std::uint64_t{4} << 30;
constexpr std::uint32_t zip = 1, active_mask = 2, blosc = 4;  // a grid's compression flags

class Bytes {
  public:
    explicit Bytes(const std::filesystem::path& path) : in_(path, std::ios::binary) {
        std::error_code problem;
        if (!std::filesystem::exists(path, problem)) throw std::runtime_error("no such file");
        if (!std::filesystem::is_regular_file(path, problem) || !in_)
            throw std::runtime_error("it is not a readable file");
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
        // Read short ranges instead, because seeking discards the stream's buffer.
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
    [[noreturn]] static void cut_off() { throw std::runtime_error("it is truncated or damaged"); }

  private:
    void read(void* to, std::uint64_t count) {
        if (count > size_ - at_ || !in_.read(static_cast<char*>(to), static_cast<std::streamsize>(count))) cut_off();
        at_ += count;
    }

    std::ifstream in_;
    std::uint64_t size_ = 0, at_ = 0;
};

// The number of bytes that OpenVDB reads for a value of this type, whatever length the file states; nullopt if it reads
// as many as stated. With any other length it would continue at another position than this walk.
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

// Skips `packed` bytes compressed by Blosc: a 16-byte header, with the unpacked length at byte 4 and the packed length
// at byte 12, followed by the data. Blosc trusts its header, so both lengths must fit the available space.
void skip_blosc(Bytes& file, std::uint64_t packed, std::initializer_list<std::uint64_t> allowed_unpacked) {
    if (packed < 16) Bytes::cut_off();
    file.skip(4);
    const std::uint64_t unpacked = file.number<std::uint32_t>();
    file.skip(4);
    if (file.number<std::uint32_t>() > packed || std::ranges::count(allowed_unpacked, unpacked) == 0) Bytes::cut_off();
    file.skip(packed - 16);
}

// Skips an array of the metadata below and returns its length in the file. `packed` is its length if it is compressed,
// else 0. Arrays of less than 128 bytes are padded to 128 before compression.
std::uint64_t skip_array(Bytes& file, std::uint32_t packed, std::uint64_t bytes) {
    constexpr std::uint64_t padded = 128;
    if (packed == 0)
        file.skip(bytes);
    else
        skip_blosc(file, packed, {bytes, bytes < padded ? padded : bytes});
    return packed == 0 ? bytes : packed;
}

// Skips the metadata for loading leaves on demand: one byte per leaf and, unless the second length is the largest
// number, eight more. Later versions may append to it.
void skip_delayed_load(Bytes& file, std::uint32_t bytes) {
    if (bytes == 0) return;
    const auto leaves = file.number<std::uint32_t>();
    // Each leaf takes at least 64 bytes of the file.
    if (leaves > file.size() / 64) Bytes::cut_off();
    std::uint64_t read = 12 + skip_array(file, file.number<std::uint32_t>(), leaves);
    if (const auto packed = file.number<std::uint32_t>(); packed != 0xFFFFFFFF)
        read += skip_array(file, packed, std::uint64_t{leaves} * 8);
    if (read > bytes) Bytes::cut_off();
    file.skip(bytes - read);
}

// Skips a list of names, types and values.
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

// The number of doubles that describe a linear transform of this type; nullopt for other types.
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
        // A box, a taper and a depth, followed by another transform. OpenVDB follows nested ones to any depth; in
        // practice the inner one is always linear.
        file.skip(8 * 8);
        type = file.text();
    }
    const auto doubles = doubles_of_linear_transform(type);
    if (!doubles) throw std::runtime_error("it has a grid with an unknown kind of transform");
    file.skip(8 * *doubles);
}

// A mask of the 2^(3 log2) positions of a node.
struct Mask {
    std::vector<std::uint64_t> words;

    Mask(Bytes& file, unsigned log2) : words((std::size_t{1} << (3 * log2)) / 64) { file.read_words(words); }
    std::uint64_t count() const {
        std::uint64_t on = 0;
        for (const std::uint64_t w : words) on += static_cast<std::uint64_t>(std::popcount(w));
        return on;
    }
};

struct ValueBytes {
    unsigned in_memory, in_file;
};

// The size of a value in a tree of this type; nullopt if grids of the type are not read. OpenVDB can store
// floating-point numbers as halves. It gives the type of such a grid a suffix, even if its values are integers, which
// are stored unchanged.
std::optional<ValueBytes> value_bytes_of(const std::string& type) {
    for (const auto& [name, bytes] : {std::pair{"float", 4u}, std::pair{"double", 8u}}) {
        if (type == fmt::format("Tree_{}_5_4_3", name)) return ValueBytes{bytes, bytes};
        if (type == fmt::format("Tree_{}_5_4_3_HalfFloat", name)) return ValueBytes{bytes, 2};
    }
    for (const auto& [name, bytes] : {std::pair{"int32", 4u}, std::pair{"int64", 8u}})
        if (type == fmt::format("Tree_{}_5_4_3", name) || type == fmt::format("Tree_{}_5_4_3_HalfFloat", name))
            return ValueBytes{bytes, bytes};
    return std::nullopt;
}

// Walks one grid's tree: a root, nodes of 32³ and of 16³ positions, and leaves of 8³.
class TreeWalk {
  public:
    TreeWalk(Bytes& file, std::uint32_t compression, const ValueBytes& bytes)
        : file_(file),
          compression_(compression),
          value_bytes_(bytes.in_memory),
          stored_bytes_(bytes.in_file),
          has_halves_(bytes.in_file != bytes.in_memory) {}

    void operator()() {
        file_.skip(4);             // the number of buffers, stored once
        file_.skip(value_bytes_);  // the background
        const auto tiles = file_.number<std::uint32_t>(), children = file_.number<std::uint32_t>();
        file_.skip(std::uint64_t{tiles} * (13 + value_bytes_));
        // Each child takes more than a thousand bytes.
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
    // Skips the values of a node: how inactive ones are stored, their values, and the rest, which may be compressed.
    void values(const Mask& is_active, unsigned log2) {
        const std::uint64_t places = std::uint64_t{1} << (3 * log2);
        const auto how = file_.number<std::int8_t>();
        if (how < 0 || how > 6) Bytes::cut_off();
        if (how == 2 || how == 4 || how == 5) file_.skip(value_bytes_);
        if (how == 5) file_.skip(value_bytes_);
        if (how >= 3 && how <= 5) file_.skip(places / 8);
        const bool is_short = (compression_ & active_mask) != 0 && how != 6;
        const std::uint64_t bytes = (is_short ? is_active.count() : places) * stored_bytes_;
        // An empty array of halves does not even have a length.
        if (bytes == 0 && has_halves_) return;
        if ((compression_ & (zip | blosc)) == 0) return file_.skip(bytes);
        const auto packed = file_.number<std::int64_t>();
        if (packed > 0 && (compression_ & blosc) != 0)
            return skip_blosc(file_, static_cast<std::uint64_t>(packed), {bytes});
        if (packed > 0) return file_.skip(static_cast<std::uint64_t>(packed));
        // Uncompressed values are preceded by their negated length.
        if (0 - static_cast<std::uint64_t>(packed) != bytes) Bytes::cut_off();
        file_.skip(bytes);
    }
    void pay(std::uint64_t bytes) {
        paid_ += bytes;
        if (paid_ > max_bytes)
            throw std::runtime_error(fmt::format("one of its grids needs more than {} GB of memory", max_bytes >> 30));
    }

    Bytes& file_;
    std::uint32_t compression_;
    unsigned value_bytes_, stored_bytes_;
    bool has_halves_;
    std::uint64_t leaves_ = 0, paid_ = 0;
};

void check_grid(Bytes& file, const std::string& type, bool is_instance) {
    const auto compression = file.number<std::uint32_t>();
    skip_metadata(file);
    skip_transform(file);
    const std::optional<ValueBytes> bytes = value_bytes_of(type);
    if (bytes && !is_instance) TreeWalk(file, compression, *bytes)();
}

}  // namespace

void check_vdb_structure(const std::filesystem::path& path) {
    Bytes file(path);
    if (file.size() < 8 || file.number<std::uint64_t>() != magic) throw std::runtime_error("it is not an OpenVDB file");
    const auto version = file.number<std::uint32_t>();
    if (version < oldest)
        throw std::runtime_error("it was written by an OpenVDB version before 1.1; save it again with a newer one");
    file.skip(8);
    if (file.number<std::int8_t>() == 0)
        throw std::runtime_error("it is a stream without an index of its grids; save it as a file");
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
        // Each grid must follow its own description, and the next one must follow it, so that nothing is walked twice.
        if (grid < 0 || static_cast<std::uint64_t>(grid) < file.at()) Bytes::cut_off();
        file.go_to(static_cast<std::uint64_t>(grid));
        check_grid(file, type, is_instance);
        if (end < 0 || static_cast<std::uint64_t>(end) < file.at()) Bytes::cut_off();
        file.go_to(static_cast<std::uint64_t>(end));
    }
}

}  // namespace phasetree::tracer
