// How hard randomised tests try: sanitizers make everything several times slower.
#pragma once

namespace clothlab::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// A number of attempts, fewer under a sanitizer.
constexpr int attempts(int number) {
    return sanitized ? (number + 9) / 10 : number;
}

} // namespace clothlab::test
