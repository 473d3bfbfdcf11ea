/// @file
/// Scalar, vector and identifier types.
///
/// Numeric kernels are templates on the scalar S and are instantiated for double and std::complex<double>: the complex
/// step Im f(q + i h e) / h is the test oracle of every analytic derivative. Hence no conjugating operation (dot,
/// cross, adjoint of Eigen) appears in them.
#pragma once

#include <Eigen/Core>

#include <compare>
#include <complex>
#include <numbers>
#include <vector>

namespace cardan {

template <class S>
using Vec3T = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vec6T = Eigen::Matrix<S, 6, 1>;
template <class S>
using Mat3T = Eigen::Matrix<S, 3, 3>;
template <class S>
using Mat6T = Eigen::Matrix<S, 6, 6>;
template <class S>
using VectorT = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using MatrixT = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

using Vec3 = Vec3T<double>;
using Vec6 = Vec6T<double>;
using Mat3 = Mat3T<double>;
using Mat6 = Mat6T<double>;
using Vector = VectorT<double>;
using Matrix = MatrixT<double>;
using Complex = std::complex<double>;
using ComplexVector = VectorT<Complex>;
using ComplexMatrix = MatrixT<Complex>;

/// Arguments of kernels: contiguous vectors and column-major matrices, which are never copied. They are members, so
/// that the scalar is that of the Kinematics argument alone, and so that all compilers make the same symbol of a
/// kernel's signature: of Eigen::Ref, whose default arguments depend on the scalar, GCC and clang do not.
template <class S>
struct ArgumentsT {
    using VectorIn = const Eigen::Ref<const VectorT<S>>&;
    using VectorOut = Eigen::Ref<VectorT<S>>;
    using MatrixOut = Eigen::Ref<MatrixT<S>>;
};
template <class S>
using VectorInT = typename ArgumentsT<S>::VectorIn;
template <class S>
using VectorOutT = typename ArgumentsT<S>::VectorOut;
template <class S>
using MatrixOutT = typename ArgumentsT<S>::MatrixOut;

using VectorIn = VectorInT<double>;
using VectorOut = VectorOutT<double>;
using MatrixIn = const Eigen::Ref<const Matrix>&;
using MatrixOut = MatrixOutT<double>;

/// A body of a Tree, in the order of insertion. (In the sorted Model a body is its coordinate index.)
struct BodyId {
    int index = -1;
    auto operator<=>(const BodyId&) const = default;
};

/// A frame of a Tree or Model; frame 0 is the base (the fixed ground frame).
struct FrameId {
    int index = 0;
    auto operator<=>(const FrameId&) const = default;
};

inline constexpr double pi = std::numbers::pi;

}  // namespace cardan
