/// @file
/// Multi-blade (Coleman) transformation of a linearised machine to the fixed frame.
#pragma once

#include "mbs/model/rotor_map.hpp"
#include "solvers/linear/linearise.hpp"

#include <span>
#include <string>

namespace cardan::solvers {

/// Kind of a row of a transformed system: a coordinate itself, or one multi-blade combination of a blade coordinate.
enum class MultiBlade : std::uint8_t { none, collective, cosine, sine, differential };

struct MultiBladeRow {
    MultiBlade kind = MultiBlade::none;
    int harmonic = 0;           ///< of cosine and sine: 1 ... (B - 1) / 2
    int blade_coordinate = -1;  ///< position in RotorMap::blades[k]; -1: not a blade coordinate (without blades, cosine
                                ///< and sine are the members of a rotating pair, ordered such that forward is + i)
};

/// "collective", "cosine 1", "sine 1", "differential"; empty for a coordinate itself.
std::string multi_blade_name(const MultiBladeRow& row);

/// T(psi) of one blade coordinate (see ColemanTransform): a row for every blade, a column for every slot.
/// @param slots  as many as blades
Matrix multi_blade_block(std::span<const MultiBladeRow> slots, double psi = 0);

/// Reason for which blades are not evenly spaced: "blade 2 of 3 is missing", "the blades are not evenly spaced"; empty
/// if they are.
std::string uneven_spacing(const RotorMap& rotor);
/// Reason for which the blades of a rotor have no multi-blade coordinates over a set of coordinates; empty if they
/// have: uneven_spacing() of three and more (sum and difference of two need no even spacing), or "blade 2 has other
/// coordinates than blade 1".
std::string without_multi_blade_coordinates(const RotorMap& rotor, const std::vector<int>& coordinates);

/// States of first order that belong to blades (StateInfo::blade), by their order on each: [state of a blade][blade].
/// @throws InputError if blades differ in their number
std::vector<std::vector<int>> states_of_blades(const RotorMap& rotor, const StateTable& states);

/// x = T(psi) z over a set of coordinates: blade coordinate i of blade k at azimuth psi_k = psi + 2 pi (k - 1) / B is
///
///     x_k = z_0 / sqrt B + sqrt(2/B) sum_n (z_cn cos n psi_k + z_sn sin n psi_k) + z_d (-1)^(k-1) / sqrt B (B even).
///
/// T is orthogonal, so symmetric matrices stay symmetric and energies keep their meaning. Rotating pairs (shaft
/// bending) are turned into the fixed frame. z rows replace the blades' coordinates one to one: the collective row
/// takes the place of blade 1, cosine and sine those of blades 2 and 3, and so on. States of first order that belong to
/// blades (StateInfo::blade) are transformed alike, by their order on each blade.
class ColemanTransform {
public:
    /// Two blades have the collective and the differential row only; T is constant and the system stays periodic (see
    /// floquet()). Without blades only rotating pairs are transformed.
    /// @param states  all of them
    /// @throws InputError if there is one blade or more than 32, as without_multi_blade_coordinates(), and if blades
    /// differ in their states
    ColemanTransform(const RotorMap& rotor, const std::vector<int>& coordinates, const StateTable& states = {});
    /// Whether the constructor accepts them.
    static bool exists(const RotorMap& rotor, const std::vector<int>& coordinates);

    /// T, dT/dpsi or its second derivative at azimuth psi, as a full matrix.
    Matrix matrix(double psi, int derivative = 0) const;
    /// T_s of the states, likewise.
    Matrix state_matrix(double psi, int derivative = 0) const;
    const std::vector<MultiBladeRow>& rows() const { return coordinates_.kinds; }
    /// Rows of the states; `blade_coordinate` is the position among the states of a blade.
    const std::vector<MultiBladeRow>& state_rows() const { return states_.kinds; }

    /// Two columns that rotate into one another: a' = -factor b, b' = factor a (derivatives by psi), so that T(psi) is
    /// T(0) with them rotated by factor * psi.
    struct TurningPair {
        int a, b;
        double factor;
    };
    const std::vector<TurningPair>& turning_pairs() const { return coordinates_.pairs; }
    const std::vector<TurningPair>& state_turning_pairs() const { return states_.pairs; }

    /// M x'' + C x' + K x = 0 becomes M_z z'' + C_z z' + K_z z = 0 at constant rotor speed Omega; the transformed
    /// matrices are constant for an isotropic rotor of three or more blades without gravity. With dT/dpsi = T G, G
    /// constant and of 2 x 2 blocks [0 n; -n 0],
    ///
    ///     M_z = T^T M T,  C_z = T^T C T + 2 Omega M_z G,  K_z = T^T K T + Omega (T^T C T) G + Omega^2 M_z G^2.
    ///
    /// T couples only the B blades' rows of one coordinate, and T(psi) is T(0) with its cosine-sine pairs of columns
    /// rotated by n psi.  Cost O(n^2 B).  States, with T_s and G_s of their own:
    ///
    ///     Q_s,z = T^T Q_s T_s,  f_qd,z = T_s^T f_qd T,  f_q,z = T_s^T f_q T + Omega f_qd,z G,
    ///     f_s,z = T_s^T f_s T_s - Omega G_s.
    ///
    /// @param system  overwritten by its transform; nothing is allocated once groups of f_s hold the states of all
    /// blades
    void transform_in_place(SecondOrderSystem& system, double psi, double rotor_speed) const;
    /// Transforms a copy.
    SecondOrderSystem transform(SecondOrderSystem system, double psi, double rotor_speed) const;

    static constexpr int max_blades = 32;

private:
    /// Coordinates, or states.
    struct Part {
        std::vector<std::vector<int>> at;  ///< [coordinate in blade][blade] -> row
        std::vector<TurningPair> pairs;
        std::vector<MultiBladeRow> kinds;  ///< by row
    };
    void add_blade_rows(Part& part, std::vector<int> rows, int in_blade) const;
    void add_states(const RotorMap& rotor, const StateTable& states);
    void transform_columns(const Part& part, double psi, Matrix& A) const;
    void transform_rows(const Part& part, double psi, Matrix& A) const;
    void transform_groups(double psi, GroupedMatrix& A) const;
    void congruence(double psi, Matrix& A) const;
    Matrix matrix(const Part& part, double psi, int derivative) const;
    void transform_states(StateTerms& terms, double psi, double rotor_speed) const;

    int blades_;
    Matrix blade_block_;  ///< T(0) of one coordinate: [blade][multi-blade coordinate]
    Part coordinates_, states_;
};

}  // namespace cardan::solvers
