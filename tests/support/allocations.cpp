// operator new and delete of the whole test program, in a file of their own: a compiler that sees through both of them
// takes the one for a mismatch of the other.
#include "support/allocations.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> calls{0};

void* counted(std::size_t size, std::size_t alignment) {
    ++calls;
    const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
    void* memory = alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, rounded) : std::malloc(size);
    if (!memory)
        throw std::bad_alloc();
    return memory;
}

} // namespace

std::size_t clothlab::test::allocations() {
    return calls;
}

void* operator new(std::size_t size) {
    return counted(size > 0 ? size : 1, 1);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size > 0 ? size : 1, static_cast<std::size_t>(alignment));
}
// For std::stable_sort, whose memory would come from the library's own otherwise, and go by the delete below.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++calls;
    return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    std::free(memory);
}
