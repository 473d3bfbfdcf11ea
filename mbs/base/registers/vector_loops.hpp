/// @file
/// Loops over plain numbers in whole registers, for functions marked CARDAN_VECTORISED.
#pragma once

#include "mbs/base/registers/packed.hpp"

#include <cstddef>
#include <cstring>

namespace cardan {

/// Four consecutive numbers from anywhere in memory.
CARDAN_INLINE Packed3<double> four_from(const double* x) {
    Packed3<double> four = Packed3<double>::zero();
    std::memcpy(&four.lanes, x, sizeof four.lanes);
    return four;
}

/// Sum over i < n of term(i); four(i) is the terms i ... i + 3. In eight parts, so that an addition need not wait for
/// the one before.
template <class Four, class Term>
CARDAN_INLINE double sum_by_fours(std::ptrdiff_t n, Four&& four, Term&& term) {
    Packed3<double> even = Packed3<double>::zero(), odd = Packed3<double>::zero();
    std::ptrdiff_t i = 0;
    for (; i + 8 <= n; i += 8) {
        even += four(i);
        odd += four(i + 4);
    }
    if (i + 4 <= n) {
        even += four(i);
        i += 4;
    }
    even += odd;
    double sum = (even(0) + even(2)) + (even(1) + even(3));
    for (; i < n; ++i) sum += term(i);
    return sum;
}

/// sum_i a_i b_i
template <class A, class S>
CARDAN_INLINE S dot(const A* a, const S* b, std::ptrdiff_t n) {
    const auto term = [&](std::ptrdiff_t i) CARDAN_INLINE_LAMBDA { return a[i] * b[i]; };
    if constexpr (std::is_same_v<S, double>) {
        return sum_by_fours(
            n, [&](std::ptrdiff_t i) CARDAN_INLINE_LAMBDA { return times(four_from(a + i), four_from(b + i)); }, term);
    } else {
        S sum(0);
        for (std::ptrdiff_t i = 0; i < n; ++i) sum += term(i);
        return sum;
    }
}
/// sum_i a_i (b_i - c_i)
template <class S>
CARDAN_INLINE S dot_from(const double* a, const S* b, const double* c, std::ptrdiff_t n) {
    const auto term = [&](std::ptrdiff_t i) CARDAN_INLINE_LAMBDA { return a[i] * (b[i] - c[i]); };
    if constexpr (std::is_same_v<S, double>) {
        return sum_by_fours(
            n,
            [&](std::ptrdiff_t i)
                CARDAN_INLINE_LAMBDA { return times(four_from(a + i), four_from(b + i) - four_from(c + i)); },
            term);
    } else {
        S sum(0);
        for (std::ptrdiff_t i = 0; i < n; ++i) sum += term(i);
        return sum;
    }
}

/// z_i = expression(at), where at(x) is x_i, four of them at a time: a sum of vectors times numbers. z may be one of
/// the vectors.
template <class Expression>
CARDAN_INLINE void set_by_fours(std::ptrdiff_t n, double* z, Expression&& expression) {
    std::ptrdiff_t i = 0;
    for (; i + 4 <= n; i += 4) {
        const Packed3<double> four = expression([&](const double* x) CARDAN_INLINE_LAMBDA { return four_from(x + i); });
        std::memcpy(z + i, &four.lanes, sizeof four.lanes);
    }
    for (; i < n; ++i) z[i] = expression([&](const double* x) CARDAN_INLINE_LAMBDA { return x[i]; });
}

/// y += factor x
template <class S>
CARDAN_INLINE void add_multiple(std::ptrdiff_t n, const S& factor, const S* x, S* __restrict y) {
    for (std::ptrdiff_t i = 0; i < n; ++i) y[i] += factor * x[i];
}

}  // namespace cardan
