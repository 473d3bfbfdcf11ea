#include "examples/studies/nrel5mw_assumed_modes/frequencies.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/spatial.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear/modes.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace cardan::paper2018 {

namespace {

constexpr Eigen::Index natural = 60;  // modes in which Coriolis forces are taken into account

// The mode's place among the names: edge, flap and torsion are counted as they come.
class Namer {
public:
    // @return index of the name, or `modes` for a mode that has none
    std::size_t operator()(const std::array<double, 4>& shares) {
        const auto kind = static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
        constexpr std::array<std::array<std::size_t, 2>, 4> names{{{1, 3}, {0, 2}, {4, modes}, {modes, modes}}};
        const std::size_t before = seen_.at(kind)++;
        return before < 2 ? names.at(kind).at(before) : modes;
    }

private:
    std::array<std::size_t, 4> seen_{};
};

Matrix natural_shapes(const std::vector<AssumedMode>& found, Eigen::Index count) {
    Matrix columns(found.front().shape.size(), std::min(count, std::ssize(found)));
    for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k) = entry(found, k).shape;
    return columns;
}

void check_complete(const Frequencies& hz, double rpm) {
    for (std::size_t k = 0; k < modes; ++k)
        if (hz.at(k) == 0) throw NumericalError(text("no mode is the ", mode_names.at(k), " at ", rpm, " rpm"));
}

}  // namespace

NamedModes named_modes(const AssumedModesBlade& blade, double rpm) {
    const AssumedModesMatrices matrices = blade.at(turbines::nrel5mw_spinning_hub(rpm * units::rpm));
    NamedModes named;
    Namer name;
    for (const AssumedMode& mode : natural_modes(matrices)) {
        const std::size_t k = name(energy_shares(blade, matrices, mode.shape));
        if (k == modes) continue;
        named.hz.at(k) = mode.hz;
        named.shape.at(k) = mode.shape;
    }
    check_complete(named.hz, rpm);
    return named;
}

Frequencies gyroscopic_frequencies(const AssumedModesBlade& blade, double rpm) {
    const HubMotion motion = turbines::nrel5mw_spinning_hub(rpm * units::rpm);
    const AssumedModesMatrices full = blade.at(motion);
    const Matrix columns = natural_shapes(natural_modes(full), natural);
    const AssumedModesMatrices m = blade.reduced(columns).at(motion);
    Frequencies hz{};
    Namer name;
    for (const solvers::Mode& mode : solvers::modes({m.M, m.G, m.K, m.K_elastic, {}, -1})) {
        // Energies of the two phases of a mode add up.
        std::array<double, 4> shares{};
        for (const Vector& phase : {Vector(mode.shape.real()), Vector(mode.shape.imag())}) {
            const double energy = phase.dot(m.K_elastic * phase);
            if (energy <= 0) continue;
            const auto of_phase = energy_shares(blade, full, columns * phase);
            for (std::size_t i = 0; i < shares.size(); ++i) shares.at(i) += energy * of_phase.at(i);
        }
        const std::size_t k = name(shares);
        if (k < modes) hz.at(k) = mode.natural_hz();
    }
    check_complete(hz, rpm);
    return hz;
}

Frequencies stretched_frequencies(double rpm) {
    const BeamLine line = turbines::nrel5mw_blade().line;
    return gyroscopic_frequencies(
        turbines::nrel5mw_blade_converged(stretched(line, turbines::nrel5mw_spinning_hub(rpm * units::rpm))), rpm);
}

std::array<double, 3> torsion_at_rest(const AssumedModesBasis& basis) {
    const BeamLine line = turbines::nrel5mw_blade().line;
    BeamLine unscaled = line, about_axis = line;
    unscaled.section = [line](double x) {
        BeamSection s = line.section(x);
        s.J /= turbines::Nrel5mwBladeOptions().mass_factor;
        return s;
    };
    about_axis.section = [line](double x) {
        BeamSection s = line.section(x);
        const Mat3 offset = skew(s.centre);
        s.J += s.mass * offset * offset;
        return s;
    };
    std::array<double, 3> hz{};
    for (std::size_t i = 0; const BeamLine& variant : {line, unscaled, about_axis})
        hz.at(i++) =
            named_modes(turbines::nrel5mw_blade_of_2018(basis, TensionIntegral::from_free_tip, variant), 0).hz.back();
    return hz;
}

Frequencies untwisted_at_rest(const AssumedModesBasis& basis) {
    BeamLine line = turbines::nrel5mw_blade().line;
    line.section = [own = line.section](double x) {
        BeamSection s = own(x);
        const Mat3 R = Eigen::AngleAxisd(-s.beta, Vec3::UnitX()).toRotationMatrix();
        Mat6 T = Mat6::Zero();
        T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() = R;
        s.compliance = (T * s.compliance * T.transpose()).eval();
        s.J = (R * s.J * R.transpose()).eval();
        s.centre.setZero();
        s.beta = 0;
        return s;
    };
    return named_modes(turbines::nrel5mw_blade_of_2018(basis, TensionIntegral::from_free_tip, line), 0).hz;
}

std::vector<Frequencies> chain_frequencies(int elements, const std::vector<double>& rpm) {
    const auto isolated =
        turbines::isolated_blade(turbines::nrel5mw_blade(), turbines::nrel5mw_blade_elements(elements));
    std::vector<double> speeds = rpm;
    for (double& speed : speeds) speed *= units::rpm;
    solvers::CampbellOptions options;
    options.max_frequency_hz = 15;
    const solvers::Campbell diagram = solvers::campbell(isolated.system(), isolated.rotor(), speeds, options);
    constexpr std::array branches{"1st blade flap", "1st blade edge", "2nd blade flap", "2nd blade edge",
                                  "1st blade torsion"};
    std::vector<Frequencies> found(rpm.size());
    for (std::size_t i = 0; i < rpm.size(); ++i)
        for (std::size_t k = 0; k < modes; ++k) found[i].at(k) = diagram.natural_hz(diagram.branch(branches.at(k)), i);
    return found;
}

}  // namespace cardan::paper2018
