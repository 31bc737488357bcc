// Whether the tests, and with them the command, are built for a sanitizer.
#pragma once

namespace phasetree::tests {

// A sanitizer keeps what was freed, guards what is used, and starts a thread of its own: how much memory or how many
// threads a run takes then says nothing of the program. Tests of that are skipped.
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

// About how many times as long the command takes. What is to be interrupted in the middle is given as much longer.
inline constexpr int sanitizer_slowdown = under_sanitizer ? 10 : 1;

}  // namespace phasetree::tests
