// Counts what the test program allocates.
#pragma once

#include <cstddef>

namespace clothlab::test {

/// Calls of operator new so far, by all threads.
std::size_t allocations();

} // namespace clothlab::test
