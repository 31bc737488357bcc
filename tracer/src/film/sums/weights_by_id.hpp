// The weight of each of several IDs in a pixel; the basis of Cryptomatte.
#pragma once

#include <algorithm>
#include <vector>

#include "film/sums/fixed_sum.hpp"

namespace phasetree::tracer {

class WeightsById {
  public:
    struct Entry {
        std::uint32_t id = 0;
        WeightSum weight;

        bool operator==(const Entry&) const = default;
    };

    /// `weight` is from 0 to 1.
    void add(std::uint32_t id, float weight, FilmFaults& faults) { at(id).add(static_cast<double>(weight), faults); }
    WeightsById& operator+=(const WeightsById& other) {
        for (const Entry& entry : other.entries_) at(entry.id) += entry.weight;
        return *this;
    }

    /// By increasing IDs, each of them once.
    const std::vector<Entry>& entries() const { return entries_; }

    bool operator==(const WeightsById&) const = default;
    void write(ByteWriter& out) const {
        out.number(static_cast<std::uint32_t>(entries_.size()));
        for (const Entry& entry : entries_) {
            out.number(entry.id);
            entry.weight.write(out);
        }
    }
    static WeightsById read(ByteReader& in) {
        WeightsById weights;
        const auto count = in.number<std::uint32_t>();
        // No memory is reserved for `count` entries. If the count is wrong, reading fails at the end of the bytes, and
        // until then memory grows only in proportion to them.
        for (std::uint32_t i = 0; i < count; ++i) {
            Entry entry{in.number<std::uint32_t>(), WeightSum::read(in)};
            if (i > 0 && entry.id <= weights.entries_.back().id) throw BytesError("its identifiers are not sorted");
            weights.entries_.push_back(entry);
        }
        return weights;
    }

  private:
    WeightSum& at(std::uint32_t id) {
        const auto place = std::ranges::lower_bound(entries_, id, {}, &Entry::id);
        if (place != entries_.end() && place->id == id) return place->weight;
        return entries_.insert(place, {id, {}})->weight;
    }

    std::vector<Entry> entries_;
};

}  // namespace phasetree::tracer
