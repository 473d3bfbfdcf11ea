// Every function template that the libraries instantiate, named so that the linker has to find its symbol: what depends
// on a scalar is written out in it, and compilers may differ in how. The test `instantiations` looks for all of them
// here.
#include <cardan/elements/machine_elements/rotor_load.hpp>
#include <cardan/mbs/kernels/christoffel.hpp>
#include <cardan/mbs/kernels/dynamics.hpp>
#include <cardan/mbs/kernels/lagrange.hpp>
#include <cardan/mbs/system/forces.hpp>

namespace cardan {
namespace {

template <class... Functions>
void name(Functions... functions) {
    const auto keep = [](auto function) { [[maybe_unused]] volatile auto kept = function; };
    (keep(functions), ...);
}

template <class S>
void name_all() {
    name(&kinematics<S>, &basis_functions<S>, &pose<S>, &frame_jacobian<S>);
    name(&body_inertias<S>, &subtree_centres<S>, &composites<S>, &add_armatures<S>, &metric<S>);
    name(&christoffel_along<S>, &inverse_dynamics<S>, &inertial_forces<S>);
    name(&lagrange::metric<S>, &lagrange::christoffel_first_kind<S>);
    name(&Loops::residual<S>, &Loops::gradient<S>, &Loops::bias<S>);
    name(&Forces::generalised_forces_of_laws<S>);
    name(&RotorCurve::torque<S>, &RotorCurve::thrust_force<S>);
}

}  // namespace

void name_all_instantiated() {
    name(&Forces::require_state<double>);
    name_all<double>();
    name_all<Complex>();
}

}  // namespace cardan
