#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree {

/// The contents of a Document. All values are in one array, in which the items of an array and the members of an object
/// are contiguous. So a document of any depth and width is destroyed without recursion.
struct DocumentData {
    struct Span {
        std::uint32_t first;
        std::uint32_t count;
    };

    /// 16 bytes per value: a list of ten million numbers takes 160 MB.
    struct Entry {
        union {
            double number;
            bool boolean;
            Span span;  ///< in `strings` for a string, in `values` for an array or an object
        };
        std::uint32_t offset : 28;  ///< < Document::max_bytes = 2²⁸
        std::uint32_t kind : 4;
        std::uint32_t key;  ///< index into `keys`, or no_key
    };
    static_assert(sizeof(Entry) == 16);
    static_assert(Document::max_bytes == std::size_t{1} << 28);
    static constexpr std::uint32_t no_key = 0xFFFFFFFF;

    struct Key {
        Span span;  ///< in `strings`
        std::uint32_t offset;
    };

    /// The members of a wide object, sorted by key, for find().
    struct Index {
        std::uint32_t first;  ///< the object's first member in `values`; indices are sorted by this
        std::uint32_t begin;  ///< in `by_key`
    };
    static constexpr std::uint32_t wide = 16;  ///< objects with more members than this have an index

    std::string name;
    std::string text;
    std::string strings;  ///< all strings and keys, unescaped and concatenated
    std::vector<Entry> values;
    std::vector<Key> keys;
    std::vector<Index> indices;
    std::vector<std::uint32_t> by_key;
    std::uint32_t root = 0;

    std::string_view string(Span span) const { return std::string_view(strings).substr(span.first, span.count); }
    std::string_view key_of(const Entry& entry) const {
        return entry.key == no_key ? std::string_view() : string(keys[entry.key].span);
    }
};

}  // namespace phasetree
