#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace phasetree::rewriting {

/// Memory of one thread that is given back in the reverse order in which it was taken: what a recursion needs at each
/// of its levels, without a call of the system's allocator at any.
class Arena {
  public:
    struct Mark {
        std::size_t block = 0;
        std::byte *next = nullptr, *end = nullptr;  ///< of that block, or null before the first
    };

    /// Unset; valid until a mark set before is released.
    template <class T>
    std::span<T> take(std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
        const std::size_t bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
        if (bytes > left()) go_on(bytes);
        std::byte* const start = here_.next;
        here_.next += bytes;
        return {reinterpret_cast<T*>(start), count};
    }
    template <class T>
    std::span<T> copy(std::span<const T> from) {
        const std::span<T> to = take<T>(from.size());
        std::copy(from.begin(), from.end(), to.begin());
        return to;
    }

    Mark mark() const { return here_; }
    void release(const Mark& m) { here_ = m; }

  private:
    static constexpr std::size_t alignment = 64, first_block = std::size_t{1} << 16;
    struct alignas(alignment) Line {
        std::byte bytes[alignment];
    };
    struct Block {
        std::unique_ptr<Line[]> memory;
        std::size_t size;
    };
    std::size_t left() const { return static_cast<std::size_t>(here_.end - here_.next); }
    /// To the next block that has so much room, or a new one.
    void go_on(std::size_t bytes) {
        std::size_t block = here_.next == nullptr ? 0 : here_.block + 1;
        while (block < blocks_.size() && blocks_[block].size < bytes) ++block;
        if (block == blocks_.size()) {
            const std::size_t size = std::max(bytes, blocks_.empty() ? first_block : 2 * blocks_.back().size);
            blocks_.push_back({std::make_unique_for_overwrite<Line[]>((size + alignment - 1) / alignment), size});
        }
        auto* const start = reinterpret_cast<std::byte*>(blocks_[block].memory.get());
        here_ = {block, start, start + blocks_[block].size};
    }
    std::vector<Block> blocks_;
    Mark here_;
};

/// Gives back at the end of a scope what was taken in it.
class ArenaScope {
  public:
    explicit ArenaScope(Arena& arena) : arena_(arena), mark_(arena.mark()) {}
    ~ArenaScope() { arena_.release(mark_); }
    ArenaScope(const ArenaScope&) = delete;
    ArenaScope& operator=(const ArenaScope&) = delete;

  private:
    Arena& arena_;
    Arena::Mark mark_;
};

}  // namespace phasetree::rewriting
