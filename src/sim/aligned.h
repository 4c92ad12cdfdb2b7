// Arrays that start on a cache line and end with some memory to spare, so that the last vector of points may be read
// and written whole.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <new>
#include <vector>

namespace clothlab::sim {

template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t alignment{64};
    CacheLineAllocator() = default;
    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}
    static constexpr std::size_t spare = 64; ///< bytes: a vector of the widest instruction set
    T* allocate(std::size_t n) {
        auto* bytes = static_cast<std::byte*>(::operator new(n * sizeof(T) + spare, alignment));
        std::memset(bytes + n * sizeof(T), 0, spare);
        return reinterpret_cast<T*>(bytes);
    }
    void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
    bool operator==(const CacheLineAllocator&) const = default;
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

/// Three coordinates of n points, structure of arrays.
template <class Real>
struct Vec3Array {
    AlignedVector<Real> x, y, z;
    void resize(std::size_t n) {
        x.resize(n);
        y.resize(n);
        z.resize(n);
    }
    std::size_t size() const { return x.size(); }
    std::array<Real*, 3> axes() { return {x.data(), y.data(), z.data()}; }
    std::array<const Real*, 3> axes() const { return {x.data(), y.data(), z.data()}; }
    std::size_t bytes() const { return (x.capacity() + y.capacity() + z.capacity()) * sizeof(Real); }
    bool operator==(const Vec3Array&) const = default;
};

} // namespace clothlab::sim
