/// @file
/// Components in axes d, q as one number, for scalars that may be complex themselves.
#pragma once

namespace cardan::detail {

/// d + j q.
template <class S>
struct Phasor {
    S d{}, q{};

    friend Phasor operator+(const Phasor& a, const Phasor& b) { return {a.d + b.d, a.q + b.q}; }
    friend Phasor operator-(const Phasor& a, const Phasor& b) { return {a.d - b.d, a.q - b.q}; }
    template <class F>
    friend Phasor operator*(const F& factor, const Phasor& a) {
        return {factor * a.d, factor * a.q};
    }
    /// j a: a quarter turn ahead.
    friend Phasor turned(const Phasor& a) { return {-a.q, a.d}; }
    /// a b as complex numbers.
    friend Phasor product(const Phasor& a, const Phasor& b) { return {a.d * b.d - a.q * b.q, a.d * b.q + a.q * b.d}; }
    friend S dot(const Phasor& a, const Phasor& b) { return a.d * b.d + a.q * b.q; }
    /// Im(conj(a) b).
    friend S cross(const Phasor& a, const Phasor& b) { return a.d * b.q - a.q * b.d; }
    friend Phasor quotient(const Phasor& a, const Phasor& b) {
        const S size = dot(b, b);
        return {(a.d * b.d + a.q * b.q) / size, (a.q * b.d - a.d * b.q) / size};
    }
};

}  // namespace cardan::detail
