#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace phasetree::embree::api {

/// Reference-counted objects behind handles, which are integers stored as pointers, never addresses: a table index and
/// the number of times that it has been reused. Freed or invented handles, and pointers from other libraries, are thus
/// recognised without being dereferenced. The check takes a few loads and no lock, so that callbacks can use it.
///
///     bits 63 … 48   the kind's tag: not an address in user space on any 64-bit machine
///     bits 47 … 24   the number of earlier objects at this index
///     bits 23 … 0    the index
///
/// The table is the library's only process-wide state; without it, freeing a handle twice could not be detected.
template <class T, std::uint16_t tag>
class HandleTable {
    static_assert(sizeof(void*) == 8, "handles need pointers of 64 bits");
    static_assert((tag >> 15) != (tag >> 14 & 1), "an address has sixteen equal bits on top");

  public:
    using Value = std::uint64_t;

    /// Never destroyed, because applications may release their last handles during process exit. Leak checkers see it
    /// as reachable.
    static HandleTable& instance() {
        static HandleTable& table = *std::make_unique<HandleTable>().release();
        return table;
    }

    Value insert(std::unique_ptr<T> object) {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) grow();
        const std::uint32_t place = free_.back();
        free_.pop_back();
        Slot& slot = *find_slot(place);
        slot.object = std::move(object);
        const std::uint64_t generation = slot.state.load(std::memory_order_relaxed) >> 32;
        slot.state.store(generation << 32 | 1, std::memory_order_release);
        return static_cast<Value>(tag) << 48 | generation << 24 | place;
    }

    /// The object, or NULL if the handle does not belong to a live object.
    T* find(Value handle) const noexcept {
        const Slot* slot = slot_of(handle);
        if (!slot) return nullptr;
        const std::uint64_t state = slot->state.load(std::memory_order_acquire);
        return is_live(state, handle) ? slot->object.get() : nullptr;
    }

    bool retain(Value handle) noexcept {
        Slot* slot = slot_of(handle);
        if (!slot) return false;
        std::uint64_t state = slot->state.load(std::memory_order_acquire);
        do {
            if (!is_live(state, handle) || static_cast<std::uint32_t>(state) == ~0u) return false;
        } while (!slot->state.compare_exchange_weak(state, state + 1, std::memory_order_acq_rel));
        return true;
    }

    bool release(Value handle) noexcept {
        Slot* slot = slot_of(handle);
        if (!slot) return false;
        std::uint64_t state = slot->state.load(std::memory_order_acquire), next = 0;
        do {
            if (!is_live(state, handle)) return false;
            const bool last = static_cast<std::uint32_t>(state) == 1;
            next = last ? (((state >> 32) + 1) & generations) << 32 : state - 1;
        } while (!slot->state.compare_exchange_weak(state, next, std::memory_order_acq_rel));
        if (static_cast<std::uint32_t>(next) == 0) {
            const std::unique_ptr<T> object = std::move(slot->object);
            const std::lock_guard lock(mutex_);
            // An index whose generation numbers are used up is never used again.
            if (next != 0) free_.push_back(static_cast<std::uint32_t>(handle & places));
        }
        return true;
    }

  private:
    static constexpr std::uint64_t places = 0xffffff, generations = 0xffffff;
    static constexpr std::size_t chunk_size = 4096;

    struct Slot {
        std::atomic<std::uint64_t> state{0};  ///< generation · 2³² + references
        std::unique_ptr<T> object;
    };
    using Chunk = std::array<Slot, chunk_size>;

    static bool is_live(std::uint64_t state, Value handle) {
        return state >> 32 == (handle >> 24 & generations) && static_cast<std::uint32_t>(state) > 0;
    }
    Slot* find_slot(std::uint64_t place) const noexcept {
        Chunk* chunk = chunks_[place / chunk_size].load(std::memory_order_acquire);
        return chunk ? &(*chunk)[place % chunk_size] : nullptr;
    }
    Slot* slot_of(Value handle) const noexcept { return handle >> 48 == tag ? find_slot(handle & places) : nullptr; }
    void grow() {
        if (owned_.size() == chunks_.size()) throw std::bad_alloc();
        free_.reserve((owned_.size() + 1) * chunk_size);  // so that releasing never allocates
        owned_.push_back(std::make_unique<Chunk>());
        const auto first = static_cast<std::uint32_t>((owned_.size() - 1) * chunk_size);
        chunks_[owned_.size() - 1].store(owned_.back().get(), std::memory_order_release);
        for (std::uint32_t i = chunk_size; i-- > 0;) free_.push_back(first + i);
    }

    std::mutex mutex_;
    std::vector<std::unique_ptr<Chunk>> owned_;
    std::vector<std::uint32_t> free_;
    std::array<std::atomic<Chunk*>, (places + 1) / chunk_size> chunks_{};
};

}  // namespace phasetree::embree::api
