#include "image/jpeg_header.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace phasetree::tracer {

namespace {

// Markers, the bytes after 0xFF (table B.1). Those from start_of_frame on begin frames of other kinds, with three
// exceptions.
enum : int {
    start_of_frame = 0xC0,
    huffman_tables = 0xC4,
    reserved_frame = 0xC8,
    arithmetic_frame = 0xC9,
    arithmetic_tables = 0xCC,
    last_frame = 0xCF,
    first_restart = 0xD0,
    last_restart = 0xD7,
    start_of_image = 0xD8,
    end_of_image = 0xD9,
    start_of_scan = 0xDA,
};
constexpr int most_scans = 100;

bool is_frame(int marker) {
    return marker >= start_of_frame && marker <= last_frame && marker != huffman_tables && marker != reserved_frame &&
           marker != arithmetic_tables;
}
bool is_progressive_frame(int marker) {
    return (marker & 3) == 2;
}
// Markers below those of frames are skipped, as decoders do. All but one of them are unused in practice.
bool stands_alone(int marker) {
    return marker < start_of_frame || (marker >= first_restart && marker <= last_restart);
}

class JpegMarkers {
  public:
    explicit JpegMarkers(const NextBytes& next) : next_(next) {}

    JpegHeader read() {
        if (byte() != 0xFF || byte() != start_of_image) throw std::runtime_error("it is not a JPEG file");
        for (int marker; (marker = next_marker()) != end_of_image;) {
            if (stands_alone(marker)) continue;
            if (marker == start_of_image) throw std::runtime_error("it contains another image");
            std::uint64_t left = number();
            if (left < 2) throw std::runtime_error("one of its segments has an invalid length");
            left -= 2;
            if (is_frame(marker)) left -= read_frame(marker, left);
            if (marker == start_of_scan && ++header_.scans > most_scans)
                throw std::runtime_error("it has more than 100 scans; save it as a baseline JPEG");
            skip(left);
        }
        if (header_.components == 0 || header_.scans == 0) throw std::runtime_error("it has no image");
        return header_;
    }

  private:
    void need_bytes() {
        if (block_.empty()) block_ = next_();
        if (block_.empty()) throw std::runtime_error("its image data are truncated");
    }
    int byte() {
        need_bytes();
        const auto b = static_cast<unsigned char>(block_[0]);
        block_.remove_prefix(1);
        return b;
    }
    int number() {
        const int high = byte();
        return 256 * high + byte();
    }
    void skip(std::uint64_t count) {
        while (count > 0) {
            need_bytes();
            const std::uint64_t some = std::min<std::uint64_t>(count, block_.size());
            block_.remove_prefix(some);
            count -= some;
        }
    }
    // Skips everything up to the next marker: image data, in which 0 follows each 0xFF, and superfluous bytes.
    int next_marker() {
        for (;;) {
            need_bytes();
            const std::size_t at = block_.find('\xff');
            if (at == block_.npos) {
                block_ = {};
                continue;
            }
            block_.remove_prefix(at);
            int marker = 0xFF;
            while (marker == 0xFF) marker = byte();
            if (marker != 0) return marker;
        }
    }

    // Returns the number of bytes read.
    std::uint64_t read_frame(int marker, std::uint64_t length) {
        if (header_.components != 0) throw std::runtime_error("it has more than one frame");
        constexpr std::uint64_t before_components = 6, of_component = 3;
        if (length < before_components) throw std::runtime_error("its frame header is too short");
        header_.bits = byte();
        header_.height = number();
        header_.width = number();
        header_.components = byte();
        header_.is_progressive = is_progressive_frame(marker);
        if (header_.width == 0 || header_.height == 0 || header_.components == 0)
            throw std::runtime_error("it is empty");
        const auto components = static_cast<std::size_t>(header_.components);
        if (length != before_components + of_component * components)
            throw std::runtime_error("its frame header has the wrong length");
        read_sampling(components, marker >= arithmetic_frame);
        return length;
    }

    // Each block of 8 × 8 values of a component takes at least one bit, except in arithmetic coding.
    void read_sampling(std::size_t components, bool is_arithmetic) {
        std::array<int, 255> across{}, down{};
        for (std::size_t i = 0; i < components; ++i) {
            (void)byte();  // component id
            const int sampling = byte();
            across[i] = sampling >> 4;
            down[i] = sampling & 15;
            (void)byte();  // quantisation table
            if (across[i] < 1 || across[i] > 4 || down[i] < 1 || down[i] > 4)
                throw std::runtime_error("its frame has an invalid sampling factor");
        }
        const int most_across = *std::ranges::max_element(across), most_down = *std::ranges::max_element(down);
        const auto blocks = [](int size, int part, int of) {
            return static_cast<std::uint64_t>((size * part + 8 * of - 1) / (8 * of));
        };
        std::uint64_t all = 0;
        for (std::size_t i = 0; i < components; ++i)
            all += blocks(header_.width, across[i], most_across) * blocks(header_.height, down[i], most_down);
        if (!is_arithmetic) header_.least_bytes = all / 8;
    }

    const NextBytes& next_;
    std::string_view block_;
    JpegHeader header_;
};

}  // namespace

JpegHeader read_jpeg_header(const NextBytes& next) {
    return JpegMarkers(next).read();
}

}  // namespace phasetree::tracer
