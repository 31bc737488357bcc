#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace phasetree::rewriting {

/// A stack allocator for one thread. A recursion allocates what each of its levels needs and releases it on return, so
/// that no level calls the system's allocator. Blocks double in size and are reused until the arena is destroyed.
class Arena {
  public:
    /// A height of the stack.
    struct Mark {
        std::size_t block = 0;
        std::byte *next = nullptr, *end = nullptr;  ///< the unused part of that block; null before the first block
    };

    /// Memory for `count` uninitialised objects. It is valid until a mark set earlier is released.
    template <class T>
    std::span<T> allocate(std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
        const std::size_t bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
        if (bytes > unused_bytes()) open_block(bytes);
        std::byte* const start = top_.next;
        top_.next += bytes;
        return {reinterpret_cast<T*>(start), count};
    }
    template <class T>
    std::span<T> copy(std::span<const T> from) {
        const std::span<T> to = allocate<T>(from.size());
        std::copy(from.begin(), from.end(), to.begin());
        return to;
    }

    Mark mark() const { return top_; }
    void release(const Mark& m) { top_ = m; }

  private:
    static constexpr std::size_t alignment = 64, first_block_bytes = std::size_t{1} << 16;
    struct alignas(alignment) Line {
        std::byte bytes[alignment];
    };
    struct Block {
        std::unique_ptr<Line[]> memory;
        std::size_t size;
    };
    std::size_t unused_bytes() const { return static_cast<std::size_t>(top_.end - top_.next); }
    /// Moves the top to the next block with this much room, or to a new block.
    void open_block(std::size_t bytes);

    std::vector<Block> blocks_;
    Mark top_;
};

/// Releases, at the end of a scope, everything allocated in it.
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

/// The two arenas of a function that returns something large.
struct Arenas {
    Arena& results;  ///< for the result
    Arena& scratch;  ///< for temporary data, until the function returns
};

}  // namespace phasetree::rewriting
