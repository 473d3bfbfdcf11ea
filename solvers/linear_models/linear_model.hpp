/// @file
/// Linear models x' = A x + B u, y = C x + D u of a machine: data, Fourier coefficients, transfer functions.
#pragma once

#include "mbs/base/types.hpp"

#include <set>
#include <string>
#include <vector>

namespace cardan::solvers {

/// The context named in errors about linear models.
inline constexpr const char* in_linear_model = "linear model";

/// A state, an input or an output.
struct Signal {
    std::string name;            ///< "blade 1 root moment y"
    std::string units;           ///< SI in the notation of the channels, e.g. "rad s-1"
    std::string long_name = {};  ///< one line
    std::string alias = {};      ///< name in OpenFAST, if it has one
    /// Blade number from 1 of a signal that all blades have, in the rotating frame; 0: none.
    int blade = 0;
};

struct StateMatrices {
    Matrix A, B, C, D;
};

/// The matrices at one azimuth and the operating point they belong to.
struct LinearSample : StateMatrices {
    double azimuth = 0;  ///< of blade 1, the spin coordinate, rad
    double time = 0;     ///< s, at which explicit functions of time were evaluated
    Vector x, xdot;      ///< states and their derivatives
    Vector u;            ///< positions, rates and accelerations of driven coordinates; forces are zero
    Vector y;
};

/// Deviations from a steady state that is periodic in the azimuth (or constant): x' = A(psi) x + B(psi) u,
/// y = C(psi) x + D(psi) u, at equidistant azimuths.
struct LinearModel {
    std::string machine, description;
    double rotor_speed = 0;  ///< rad/s
    int blades = 0;
    /// Positions first, then the rates in the same order, then states of first order (Forces::states()).
    std::vector<Signal> states;
    std::vector<Signal> inputs, outputs;
    std::vector<int> coordinates;  ///< model index of every position among the states
    int first_order = 0;           ///< number of states of first order
    std::vector<LinearSample> samples;
    /// Per output: estimated error of the finite differences behind C and D, relative to the largest difference caused
    /// by a step of any state or input.
    Vector output_error;
    /// Largest residual acceleration of the equations of motion at the operating points, rad/s^2 or m/s^2, spin
    /// excluded: zero for an exact steady state.
    double imbalance = 0;
};

/// A(psi) = A_0 + sum_j Ac_j cos j psi + As_j sin j psi, and so on, as A_0, Ac_1, As_1, Ac_2, ...
/// @param harmonics  number of them; negative: as many as the samples determine
/// @throws InputError for more harmonics than that
std::vector<StateMatrices> fourier_coefficients(const LinearModel& model, int harmonics = -1);
/// The sum of a series at an azimuth.  @throws InputError without coefficients or with an even number of them
StateMatrices evaluate(const std::vector<StateMatrices>& coefficients, double psi);

/// A linear model with constant matrices.
struct ConstantModel : StateMatrices {
    std::string machine, description;
    double rotor_speed = 0;  ///< rad/s
    /// States of a reduced model have no physical meaning and names like "modal state 3".
    std::vector<Signal> states;
    std::vector<Signal> inputs, outputs;

    /// G(s) = C (s - A)^-1 B + D.  @throws NumericalError if s is exactly a pole; close to a pole accuracy is limited
    /// by rounding
    ComplexMatrix transfer(Complex s) const;
    /// Poles in ascending magnitude; in conjugate pairs the one with positive imaginary part comes first.
    std::vector<Complex> poles() const;
};

/// A model and its name in a file.
struct NamedModel {
    std::string name;
    ConstantModel model;
};

/// Rejects names that are not MATLAB identifiers, occur twice or are already `taken` in the file.
/// @param file  the kind of file, for the message
/// @throws InputError
void check_names(const std::vector<NamedModel>& models, const char* file, std::set<std::string> taken);

/// The model at one azimuth, as it is.
ConstantModel at_sample(const LinearModel& model, std::size_t sample);

/// Index by name or alias. @throws InputError with the name and those that exist
std::size_t index_of(const std::vector<Signal>& signals, std::string_view name);

}  // namespace cardan::solvers
