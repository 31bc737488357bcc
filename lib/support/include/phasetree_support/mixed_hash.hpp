#pragma once

#include <cstdint>

namespace phasetree::support {

/// Combines a hash with one more value. Changing only the hash, or only the value, always changes the result.
inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
    hash = (hash ^ value) * 0x9e3779b97f4a7c15u;  // odd, so that no bit is lost: 2⁶⁴ over the golden ratio
    return hash ^ (hash >> 32);
}

}  // namespace phasetree::support
