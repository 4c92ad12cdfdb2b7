// How hard tests try: sanitizers make everything several times slower. There each piece of code runs, but less often.
#pragma once

namespace clothlab::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// A number of attempts or steps, fewer under a sanitizer.
constexpr int attempts(int number) {
    return sanitized ? (number + 9) / 10 : number;
}

} // namespace clothlab::test
