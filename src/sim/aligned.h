// Arrays that start on a cache line, so that vector loads never straddle one.
#pragma once

#include <cstddef>
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
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
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
    bool operator==(const Vec3Array&) const = default;
};

} // namespace clothlab::sim
