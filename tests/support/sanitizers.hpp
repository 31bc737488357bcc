// Whether the tests, and with them the command, are built for a sanitizer.
#pragma once

namespace phasetree::tests {

// A sanitizer keeps freed memory, surrounds used memory with guards, and starts a thread of its own. So the memory and
// the number of threads of a run say nothing about the program, and tests of these are skipped.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool under_sanitizer = true;  // GCC's names
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool under_sanitizer = true;  // Clang's
#else
inline constexpr bool under_sanitizer = false;
#endif
#else
inline constexpr bool under_sanitizer = false;
#endif

// About how many times as long the command takes with the sanitizer. Times before an interruption are multiplied by it.
inline constexpr int sanitizer_slowdown = under_sanitizer ? 10 : 1;

}  // namespace phasetree::tests
