#include "rewriting/arena.hpp"

namespace phasetree::rewriting {

void Arena::open_block(std::size_t bytes) {
    std::size_t block = top_.next == nullptr ? 0 : top_.block + 1;
    while (block < blocks_.size() && blocks_[block].size < bytes) ++block;
    if (block == blocks_.size()) {
        const std::size_t size = std::max(bytes, blocks_.empty() ? first_block_bytes : 2 * blocks_.back().size);
        blocks_.push_back({std::make_unique_for_overwrite<Line[]>((size + alignment - 1) / alignment), size});
    }
    auto* const start = reinterpret_cast<std::byte*>(blocks_[block].memory.get());
    top_ = {block, start, start + blocks_[block].size};
}

}  // namespace phasetree::rewriting
