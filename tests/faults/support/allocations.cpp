// Replaces operator new for the whole process. Allocations by the project's own code can be made to fail. An allocation
// belongs to the code that called the standard library, which is found by walking up the stack.
#include <dlfcn.h>
#include <link.h>
#include <unwind.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <iterator>
#include <new>

#include "faults/support/faults.hpp"

namespace phasetree::tests::faults {

namespace {

// operator new is a plain function: what it knows is static.
std::atomic<bool> is_armed{false}, stays{false};
std::atomic<std::size_t> count{0}, failing{0};

enum class Owner { project, standard_library, other };

// The loaded objects' segments of code, as they were when arming.
struct Range {
    std::uintptr_t begin, end;
    Owner owner;
};
Range ranges[256];
std::size_t range_count = 0;

Owner owner_of(const char* file) {
    const char* const slash = std::strrchr(file, '/');
    const char* const name = slash ? slash + 1 : file;
    if (*name == 0 || std::strncmp(name, "libphasetree", 12) == 0) return Owner::project;  // the program has no name
    for (const char* const library : {"libstdc++", "libfmt", "libc.so", "libgcc_s"})
        if (std::strncmp(name, library, std::strlen(library)) == 0) return Owner::standard_library;
    return Owner::other;
}

int add_ranges(dl_phdr_info* info, std::size_t, void*) {
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        const auto& segment = info->dlpi_phdr[i];
        if (segment.p_type != PT_LOAD || (segment.p_flags & PF_X) == 0 || range_count == std::size(ranges)) continue;
        const std::uintptr_t begin = info->dlpi_addr + segment.p_vaddr;
        ranges[range_count++] = {begin, begin + segment.p_memsz, owner_of(info->dlpi_name)};
    }
    return 0;
}

Owner owner_of(std::uintptr_t address) {
    for (std::size_t i = 0; i < range_count; ++i)
        if (address >= ranges[i].begin && address < ranges[i].end) return ranges[i].owner;
    return Owner::other;
}

// The first caller, walking up the stack, that is not the standard library.
_Unwind_Reason_Code look(_Unwind_Context* context, void* found) {
    const Owner owner = owner_of(_Unwind_GetIP(context));
    if (owner == Owner::standard_library) return _URC_NO_REASON;
    *static_cast<Owner*>(found) = owner;
    return _URC_END_OF_STACK;
}

// Unwinding may allocate: not by operator new, but who knows.
thread_local bool is_looking = false;

bool is_failing(std::uintptr_t caller) {
    if (!is_armed.load(std::memory_order_relaxed) || is_looking) return false;
    is_looking = true;
    Owner owner = owner_of(caller);
    if (owner == Owner::standard_library) {
        // The frames of this file are the program's, too.
        struct State {
            int own = 0;
            Owner owner = Owner::other;
        } state;
        _Unwind_Backtrace(
            [](_Unwind_Context* context, void* data) {
                auto& s = *static_cast<State*>(data);
                const Owner o = owner_of(_Unwind_GetIP(context));
                if (s.own == 0 && o == Owner::project) return _URC_NO_REASON;  // operator new itself
                s.own = 1;
                return look(context, &s.owner);
            },
            &state);
        owner = state.owner;
    }
    is_looking = false;
    if (owner != Owner::project) return false;
    const std::size_t n = ++count;
    return n == failing || (stays && n > failing);
}

void* allocate(std::size_t size, std::size_t alignment, std::uintptr_t caller) {
    if (is_failing(caller)) throw std::bad_alloc();
    void* p = nullptr;
    if (alignment <= alignof(std::max_align_t))
        p = std::malloc(size == 0 ? 1 : size);
    else if (::posix_memalign(&p, alignment, size) != 0)
        p = nullptr;
    if (!p) throw std::bad_alloc();
    return p;
}

std::uintptr_t address(void* p) {
    return reinterpret_cast<std::uintptr_t>(p);
}

}  // namespace

void fail_allocation(std::size_t n, bool for_good) {
    range_count = 0;
    ::dl_iterate_phdr(add_ranges, nullptr);
    count = 0;
    failing = n;
    stays = for_good;
    is_armed = true;
}

std::size_t stop_failing_allocations() {
    is_armed = false;
    return count;
}

}  // namespace phasetree::tests::faults

using phasetree::tests::faults::address;
using phasetree::tests::faults::allocate;

__attribute__((noinline)) void* operator new(std::size_t size) {
    return allocate(size, 1, address(__builtin_return_address(0)));
}
__attribute__((noinline)) void* operator new[](std::size_t size) {
    return allocate(size, 1, address(__builtin_return_address(0)));
}
__attribute__((noinline)) void* operator new(std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment), address(__builtin_return_address(0)));
}
__attribute__((noinline)) void* operator new[](std::size_t size, std::align_val_t alignment) {
    return allocate(size, static_cast<std::size_t>(alignment), address(__builtin_return_address(0)));
}
__attribute__((noinline)) void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return allocate(size, 1, address(__builtin_return_address(0)));
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
__attribute__((noinline)) void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return allocate(size, 1, address(__builtin_return_address(0)));
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* p) noexcept {
    std::free(p);
}
void operator delete[](void* p) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, std::size_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
    std::free(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept {
    std::free(p);
}
