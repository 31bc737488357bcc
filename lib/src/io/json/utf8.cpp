#include "io/json/utf8.hpp"

#include <array>

namespace phasetree::io {

namespace {

std::string encode(char32_t c) {
    const auto byte = [](char32_t bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    if (c < 0x80) return {byte(c)};
    if (c < 0x800) return {byte(0xC0 | (c >> 6)), byte(0x80 | (c & 0x3F))};
    return {byte(0xE0 | (c >> 12)), byte(0x80 | ((c >> 6) & 0x3F)), byte(0x80 | (c & 0x3F))};
}

struct Block {
    char32_t first, last;
};

bool is_in(char32_t c, auto blocks) {
    for (const Block block : blocks) {
        if (c >= block.first && c <= block.last) return true;
    }
    return false;
}

// Separators and marks without a visible glyph, C1 controls, and the marks that reorder a line (bidirectional overrides
// could make an error message read as something else).
constexpr std::array hidden = {Block{0x80, 0x9F},     Block{0xAD, 0xAD},     Block{0x61C, 0x61C},
                               Block{0x180E, 0x180E}, Block{0x200B, 0x200F}, Block{0x2028, 0x202E},
                               Block{0x2060, 0x206F}, Block{0xFEFF, 0xFEFF}, Block{0xFFF9, 0xFFFB}};
constexpr std::array combining = {Block{0x300, 0x36F},   Block{0x1AB0, 0x1AFF}, Block{0x1DC0, 0x1DFF},
                                  Block{0x20D0, 0x20FF}, Block{0xFE00, 0xFE0F}, Block{0xFE20, 0xFE2F}};
constexpr std::array wide = {Block{0x1100, 0x115F},   Block{0x2E80, 0xA4CF},   Block{0xAC00, 0xD7A3},
                             Block{0xF900, 0xFAFF},   Block{0xFE30, 0xFE6F},   Block{0xFF00, 0xFF60},
                             Block{0xFFE0, 0xFFE6},   Block{0x1F300, 0x1F64F}, Block{0x1F680, 0x1F6FF},
                             Block{0x1F900, 0x1FAFF}, Block{0x20000, 0x3FFFD}};

}  // namespace

CodePoint decode(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return static_cast<unsigned char>(at + i < text.size() ? text[at + i] : 0);
    };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return {lead, 1, true};

    std::size_t bytes = 0;
    char32_t value = 0;
    unsigned char low = 0x80, high = 0xBF;  // for the second byte
    if (lead >= 0xC2 && lead <= 0xDF) {
        bytes = 2;
        value = lead & 0x1Fu;
    } else if (lead >= 0xE0 && lead <= 0xEF) {
        bytes = 3;
        value = lead & 0x0Fu;
        if (lead == 0xE0) low = 0xA0;
        if (lead == 0xED) high = 0x9F;
    } else if (lead >= 0xF0 && lead <= 0xF4) {
        bytes = 4;
        value = lead & 0x07u;
        if (lead == 0xF0) low = 0x90;
        if (lead == 0xF4) high = 0x8F;
    } else {
        return {};
    }
    for (std::size_t i = 1; i < bytes; ++i) {
        if (byte(i) < low || byte(i) > high) return {};
        value = (value << 6) | (byte(i) & 0x3Fu);
        low = 0x80;
        high = 0xBF;
    }
    return {value, bytes, true};
}

int columns_of(char32_t c) {
    if (is_in(c, combining)) return 0;
    return is_in(c, wide) ? 2 : 1;
}

std::string printable_at(std::string_view text, std::size_t at, const CodePoint& c) {
    if (c.value < 0x20) return encode(0x2400 + c.value);
    if (c.value == 0x7F) return encode(0x2421);
    const bool is_tag = c.value >= 0xE0000 && c.value <= 0xE0FFF;
    if (!c.is_valid || is_in(c.value, hidden) || is_tag) return encode(0xFFFD);
    return std::string(text.substr(at, c.bytes));
}

std::string printable(std::string_view text, std::size_t max_code_points) {
    std::string out;
    std::size_t count = 0;
    std::size_t cut = 0;  // where to put the ellipsis if the text turns out too long
    for (std::size_t at = 0; at < text.size(); ++count) {
        if (count + 1 == max_code_points) cut = out.size();
        if (count == max_code_points) {
            out.resize(cut);
            return out + "…";
        }
        const CodePoint c = decode(text, at);
        out += printable_at(text, at, c);
        at += c.bytes;
    }
    return out;
}

std::string in_quotes(std::string_view text) {
    return '"' + printable(text, 60) + '"';
}

}  // namespace phasetree::io
