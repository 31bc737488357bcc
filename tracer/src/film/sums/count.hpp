// The number of events.
#pragma once

#include "film/bytes.hpp"

namespace phasetree::tracer {

struct Count {
    std::uint32_t count = 0;

    Count& operator+=(const Count& other) {
        count += other.count;
        return *this;
    }
    bool operator==(const Count&) const = default;
    void write(ByteWriter& out) const { out.number(count); }
    static Count read(ByteReader& in) { return {in.number<std::uint32_t>()}; }
};

}  // namespace phasetree::tracer
