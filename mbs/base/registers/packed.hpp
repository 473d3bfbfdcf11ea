/// @file
/// Three-vectors and 3 x 3 matrices as the kernels hold them: a vector fills one register of four numbers.
///
/// Everything here is inlined into functions marked CARDAN_VECTORISED; the same source also works for complex numbers,
/// element by element. The fourth number of a vector is zero. Headers that are installed do not include it.
#pragma once

#include "mbs/base/registers/vectorised.hpp"
#include "mbs/base/types.hpp"

#include <type_traits>

namespace cardan {

/// a b; of complex numbers without the C standard's care for infinite parts, which is a branch and a call in every
/// product: kernels of four hundred products took a compiler half a minute.
template <class S>
CARDAN_INLINE S product(const S& a, const S& b) {
    if constexpr (std::is_arithmetic_v<S>)
        return a * b;
    else
        return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Four numbers of any scalar, where the compiler has no vector type for them.
template <class S>
struct Four {
    S x[4];

    CARDAN_INLINE const S& operator[](std::ptrdiff_t i) const { return x[i]; }
    CARDAN_INLINE S& operator[](std::ptrdiff_t i) { return x[i]; }
    CARDAN_INLINE friend Four operator+(const Four& a, const Four& b) {
        return {{a.x[0] + b.x[0], a.x[1] + b.x[1], a.x[2] + b.x[2], a.x[3] + b.x[3]}};
    }
    CARDAN_INLINE friend Four operator-(const Four& a, const Four& b) {
        return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2], a.x[3] - b.x[3]}};
    }
    CARDAN_INLINE friend Four operator*(const Four& a, const Four& b) {
        return {{product(a.x[0], b.x[0]), product(a.x[1], b.x[1]), product(a.x[2], b.x[2]), product(a.x[3], b.x[3])}};
    }
    CARDAN_INLINE friend Four operator*(const S& s, const Four& a) {
        return {{product(s, a.x[0]), product(s, a.x[1]), product(s, a.x[2]), product(s, a.x[3])}};
    }
};

template <class S>
struct LanesOf {
    using type = Four<S>;
};
#ifdef CARDAN_HAS_VECTOR_TYPES
template <>
struct LanesOf<double> {
    using type = double __attribute__((vector_size(32)));
};
#endif

/// A vector of three numbers, always aligned like a register so that the layout does not depend on compiler flags.
template <class S>
struct alignas(std::is_same_v<S, double> ? 32 : alignof(S)) Packed3 {
    using Lanes = typename LanesOf<S>::type;
    Lanes lanes;

    Packed3() = default;
    ~Packed3() = default;
    CARDAN_INLINE Packed3(const Lanes& from) : lanes(from) {}
    // Spelled out so that a structure of several vectors is copied register by register: GCC copies aggregates in
    // halves, and a load that waits for two stores costs more than all the arithmetic of a body.
    CARDAN_INLINE Packed3(const Packed3& from) : lanes(from.lanes) {}
    CARDAN_INLINE Packed3& operator=(const Packed3& from) {
        lanes = from.lanes;
        return *this;
    }

    CARDAN_INLINE S operator()(int i) const { return lanes[i]; }
    CARDAN_INLINE Vec3T<S> vector() const { return Vec3T<S>(lanes[0], lanes[1], lanes[2]); }
    CARDAN_INLINE static Packed3 zero() { return {Lanes{}}; }
    template <class T>
    CARDAN_INLINE static Packed3 of(const T& x, const T& y, const T& z) {
        return {Lanes{S(x), S(y), S(z), S(0)}};
    }
    template <class T>
    CARDAN_INLINE static Packed3 of(const Vec3T<T>& v) {
        return of(v(0), v(1), v(2));
    }
    CARDAN_INLINE static Packed3 all(const S& s) { return {Lanes{s, s, s, s}}; }
    CARDAN_INLINE Packed3& operator+=(const Packed3& b) {
        lanes = lanes + b.lanes;
        return *this;
    }
    CARDAN_INLINE Packed3& operator-=(const Packed3& b) {
        lanes = lanes - b.lanes;
        return *this;
    }
    CARDAN_INLINE friend Packed3 operator+(const Packed3& a, const Packed3& b) { return {a.lanes + b.lanes}; }
    CARDAN_INLINE friend Packed3 operator-(const Packed3& a, const Packed3& b) { return {a.lanes - b.lanes}; }
    CARDAN_INLINE friend Packed3 operator*(const S& s, const Packed3& a) { return {s * a.lanes}; }
};

/// A 3 x 3 matrix by columns.
template <class S>
struct Packed33 {  // NOLINT(bugprone-reserved-identifier): clang's name of the index in the implicit copy constructor
    Packed3<S> column[3];

    CARDAN_INLINE const Packed3<S>& operator[](int j) const { return column[j]; }
    CARDAN_INLINE Packed3<S>& operator[](int j) { return column[j]; }
    CARDAN_INLINE Mat3T<S> matrix() const {
        Mat3T<S> m;
        for (int j = 0; j < 3; ++j) m.col(j) = column[j].vector();
        return m;
    }
    template <class T>
    CARDAN_INLINE static Packed33 of(const Mat3T<T>& m) {
        return {{Packed3<S>::of(m(0, 0), m(1, 0), m(2, 0)), Packed3<S>::of(m(0, 1), m(1, 1), m(2, 1)),
                 Packed3<S>::of(m(0, 2), m(1, 2), m(2, 2))}};
    }
    CARDAN_INLINE Packed33& operator+=(const Packed33& b) {
        for (int j = 0; j < 3; ++j) column[j] += b.column[j];
        return *this;
    }
};

/// The numbers of vectors that stand one after the other, one by one.
template <class S>
CARDAN_INLINE const S* numbers(const Packed3<S>* vectors) {
    return reinterpret_cast<const S*>(vectors);
}
template <class S>
CARDAN_INLINE S* numbers(Packed3<S>* vectors) {
    return reinterpret_cast<S*>(vectors);
}
/// The vectors that numbers fill, four each, from a multiple of 32 bytes on.
CARDAN_INLINE const Packed3<double>* vectors(const double* numbers) {
    return static_cast<const Packed3<double>*>(static_cast<const void*>(numbers));
}
CARDAN_INLINE Packed3<double>* vectors(double* numbers) {
    return static_cast<Packed3<double>*>(static_cast<void*>(numbers));
}

/// A constant in the scalar of the kernel.
template <class S>
CARDAN_INLINE Packed3<S> packed(const Packed3<double>& v) {
    if constexpr (std::is_same_v<S, double>)
        return v;
    else
        return Packed3<S>::of(v(0), v(1), v(2));
}
template <class S>
CARDAN_INLINE Packed33<S> packed(const Packed33<double>& M) {
    return {{packed<S>(M[0]), packed<S>(M[1]), packed<S>(M[2])}};
}

/// All lanes equal to lane I.
template <int I, class S>
CARDAN_INLINE Packed3<S> broadcast(const Packed3<S>& v) {
    if constexpr (std::is_class_v<typename Packed3<S>::Lanes>)
        return Packed3<S>::all(v(I));
    else
        return {__builtin_shufflevector(v.lanes, v.lanes, I, I, I, I)};
}
/// (x, y, z) -> (y, z, x)
template <class S>
CARDAN_INLINE Packed3<S> rolled(const Packed3<S>& v) {
    if constexpr (std::is_class_v<typename Packed3<S>::Lanes>)
        return Packed3<S>::of(v(1), v(2), v(0));
    else
        return {__builtin_shufflevector(v.lanes, v.lanes, 1, 2, 0, 3)};
}
/// Element by element.
template <class S>
CARDAN_INLINE Packed3<S> times(const Packed3<S>& a, const Packed3<S>& b) {
    return {a.lanes * b.lanes};
}

template <class S>
CARDAN_INLINE Packed3<S> cross(const Packed3<S>& a, const Packed3<S>& b) {
    return rolled(times(a, rolled(b)) - times(rolled(a), b));
}
template <class S>
CARDAN_INLINE S dot(const Packed3<S>& a, const Packed3<S>& b) {
    const Packed3<S> products = times(a, b);
    return products(0) + products(1) + products(2);
}
/// M v
template <class S>
CARDAN_INLINE Packed3<S> operator*(const Packed33<S>& M, const Packed3<S>& v) {
    return times(M[0], broadcast<0>(v)) + times(M[1], broadcast<1>(v)) + times(M[2], broadcast<2>(v));
}
template <class S>
CARDAN_INLINE Packed33<S> operator*(const Packed33<S>& A, const Packed33<S>& B) {
    return {{A * B[0], A * B[1], A * B[2]}};
}
template <class S>
CARDAN_INLINE Packed33<S> transpose(const Packed33<S>& M) {
    if constexpr (std::is_class_v<typename Packed3<S>::Lanes>) {
        return {{Packed3<S>::of(M[0](0), M[1](0), M[2](0)), Packed3<S>::of(M[0](1), M[1](1), M[2](1)),
                 Packed3<S>::of(M[0](2), M[1](2), M[2](2))}};
    } else {
        const Packed3<S> xz{__builtin_shufflevector(M[0].lanes, M[1].lanes, 0, 4, 2, 6)};
        const Packed3<S> y{__builtin_shufflevector(M[0].lanes, M[1].lanes, 1, 5, 3, 7)};
        return {{{__builtin_shufflevector(xz.lanes, M[2].lanes, 0, 1, 4, 7)},
                 {__builtin_shufflevector(y.lanes, M[2].lanes, 0, 1, 5, 7)},
                 {__builtin_shufflevector(xz.lanes, M[2].lanes, 2, 3, 6, 7)}}};
    }
}
/// -M a^ : the matrix with (-M a^) x = -M (a x x).
template <class S>
CARDAN_INLINE Packed33<S> minus_times_skew(const Packed33<S>& M, const Packed3<S>& a) {
    const Packed3<S> x = broadcast<0>(a), y = broadcast<1>(a), z = broadcast<2>(a);
    return {{times(M[2], y) - times(M[1], z), times(M[0], z) - times(M[2], x), times(M[1], x) - times(M[0], y)}};
}
/// E M E^T for a symmetric M given in the axes that E carries to the base.
template <class S>
CARDAN_INLINE Packed33<S> rotated(const Packed33<S>& E, const Packed33<S>& M) {
    return (E * M) * transpose(E);
}

/// Binet's tensor tr(J) / 2 - J of an inertia tensor, in the same axes.
template <class S>
CARDAN_INLINE Packed33<S> binet(const Packed33<S>& J) {
    const S half = S(0.5) * (J[0](0) + J[1](1) + J[2](2)), none(0);
    return {{Packed3<S>::of(half, none, none) - J[0], Packed3<S>::of(none, half, none) - J[1],
             Packed3<S>::of(none, none, half) - J[2]}};
}

}  // namespace cardan
