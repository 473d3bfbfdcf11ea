#pragma once

#include <Eigen/Core>

#include <array>
#include <complex>
#include <functional>

namespace cardan::oracles {

/// A wing, or one section of it on springs, in two-dimensional incompressible flow. Plunge h of the elastic axis, down,
/// and pitch alpha, nose up; per length, lift L up and moment M about the elastic axis, nose up:
///
///     L = pi rho b^2 (h'' + U alpha' - b a alpha'') + 2 pi rho U b C w,     w = h' + U alpha + b (1/2 - a) alpha',
///     M = pi rho b^2 (b a h'' - U b (1/2 - a) alpha' - b^2 (1/8 + a^2) alpha'') + 2 pi rho U b^2 (a + 1/2) C w.
///                                                                                   [Theodorsen, NACA Report 496,
///                                                                                   1935]
struct Strip {
    double half_chord;     ///< b, m
    double axis;           ///< a: elastic axis behind the middle of the chord, in half chords
    double density;        ///< rho of the air, kg/m^3
    double mass;           ///< per length, kg/m
    double static_moment;  ///< of it behind the elastic axis, kg
    double inertia;        ///< about the elastic axis, kg m
};

/// C over the reduced frequency k = omega b / U.
using Deficiency = std::function<std::complex<double>(double k)>;
/// C = H1 / (H1 + i H0), Hankel functions of the second kind.                                        [ibid., eq. (XIV)]
std::complex<double> theodorsen(double k);
/// C = 1 - sum A_i i k / (i k + b_i): indicial response by two exponentials.
struct TwoLags {
    std::array<double, 2> A, b;
    std::complex<double> operator()(double k) const;
};
/// Of a flat plate [R. T. Jones, NACA Report 681, 1940].
inline constexpr TwoLags jones_lags{{0.165, 0.335}, {0.0455, 0.3}};

/// Integrals over the span of what h = sum phi_i h_i and alpha = sum psi_j alpha_j consist of.
struct StripShapes {
    Eigen::MatrixXd plunge, mixed, pitch;               ///< of phi phi^T, phi psi^T, psi psi^T
    Eigen::MatrixXd plunge_stiffness, pitch_stiffness;  ///< N/m, N m per shape
};
/// The first bending and torsion modes, uncoupled, of a uniform cantilever.  @param count  of each
StripShapes cantilever_shapes(double length, double EI, double GJ, int count);
/// One section of unit length.
StripShapes section_shapes(double plunge_stiffness, double pitch_stiffness);

struct FlutterPoint {
    double speed;      ///< m/s
    double frequency;  ///< rad/s
};

class StripFlutter {
public:
    StripFlutter(const Strip& strip, StripShapes shapes);

    /// The lowest speed at which a motion below a frequency oscillates for ever. k-method: at a given k the motion with
    /// frequency omega obeys (M + A(k)) x = mu K x, mu = (1 + i g) / omega^2; it lasts where g = 0, which is looked for
    /// by bisection from k = 2.5 down to `min_k`.
    /// @throws std::runtime_error if there is none
    FlutterPoint flutter(const Deficiency& C, double largest_frequency, double min_k = 0.05) const;

    /// Eigenvalues of the complete equations with the states of the two lags, 1/s, those with positive imaginary part
    /// by that.
    Eigen::VectorXcd eigenvalues(const TwoLags& C, double speed) const;

    /// Lowest speed at which two undamped frequencies meet if the air makes a lift 2 pi rho U^2 b alpha only.
    FlutterPoint steady_flutter(double largest_speed) const;

    /// In vacuo, rad/s, rising.
    Eigen::VectorXd frequencies() const;

private:
    /// (L on h, L on alpha, -M on h, -M on alpha) over the shapes.
    template <class S>
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> over_shapes(S hh, S ha, S ah, S aa) const;
    Eigen::MatrixXd mass() const;
    Eigen::MatrixXd stiffness() const;
    Eigen::VectorXcd at_reduced_frequency(const Deficiency& C, double k) const;

    Strip strip_;
    StripShapes shapes_;
};

}  // namespace cardan::oracles
