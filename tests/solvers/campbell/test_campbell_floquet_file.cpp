// What Floquet's theory adds to the HDF5 file of a Campbell diagram: participation of harmonics, errors, the periodic
// steady state, kinds, stability margin, another parameter; with units and dimension scales.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/file.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

Campbell by_floquet(const SmallRotor& rotor, const std::vector<double>& speeds, RotorSpin spin = RotorSpin::prescribed,
                    int harmonics = 8) {
    CampbellOptions options;
    options.method = CampbellMethod::floquet;
    options.spin = spin;
    options.max_frequency_hz = 15;
    options.floquet.harmonics = harmonics;
    return campbell(rotor.system, rotor.map, speeds, options);
}

// Written and opened again.
struct Stored {
    explicit Stored(const Campbell& diagram) {
        write_hdf5(diagram, folder.path / "c.h5");
        file.emplace(Hdf5File::open(folder.path / "c.h5"));
    }
    test::Folder folder;
    std::optional<Hdf5File> file;
};

SmallRotor whirling_pair() {
    SmallRotorSpec spec;
    spec.stiffness = {2000, 2000};
    spec.damping = 40;
    spec.hinges = BladeHinges::flap_and_lag;
    spec.lag_damping = 60;
    spec.elastic_support = true;
    spec.gravity = {0, -units::standard_gravity, -1};
    return small_rotor(spec);
}

// Sums and differences of the blades over sqrt 2 in the places of blades 1 and 2; of the unknowns without the spin.
Matrix sums_and_differences(const SmallRotor& rotor) {
    const std::vector<int> unknowns = rotor.unknowns();
    const auto n = std::ssize(unknowns);
    const auto row = [&](int coordinate) {
        return std::find(unknowns.begin(), unknowns.end(), coordinate) - unknowns.begin();
    };
    Matrix T = Matrix::Identity(n, n);
    for (std::size_t i = 0; i < rotor.map.blades[0].size(); ++i) {
        const Eigen::Index a = row(rotor.map.blades[0][i]), b = row(rotor.map.blades[1][i]);
        T(a, a) = T(a, b) = T(b, a) = std::sqrt(0.5);
        T(b, b) = -std::sqrt(0.5);
    }
    return T;
}

}  // namespace

TEST_CASE("campbell file by Floquet: participations are the shares of the harmonics in the energy", "[crosscheck]") {
    const SmallRotor rotor = whirling_pair();
    const Campbell d = by_floquet(rotor, {0, 2});
    const Stored stored(d);
    const Hdf5File& file = *stored.file;
    CHECK(file.string_attribute("/", "method").starts_with("Floquet"));
    CHECK(file.string_attribute("/", "method_reason").empty());  // it was asked for
    const Stored chosen(campbell(rotor.system, rotor.map, {2.0}, {.max_frequency_hz = 3}));
    CHECK(chosen.file->string_attribute("/", "method_reason") == "two blades");
    std::vector<std::int64_t> expected_harmonics(17);
    std::iota(expected_harmonics.begin(), expected_harmonics.end(), -8);
    CHECK(file.read_ints("branches/harmonic") == expected_harmonics);
    const std::size_t branches = d.branches.size();
    CHECK(file.shape("branches/participation") == Shape{2, branches, 17});
    CHECK(file.dimension("branches/participation", 0) == "/branches/rotor_speed");
    CHECK(file.dimension("branches/participation", 1) == "/branches/branch");
    CHECK(file.dimension("branches/participation", 2) == "/branches/harmonic");
    CHECK(file.string_attribute("branches/participation", "units") == "1");

    // Means of M and of the stiffness of the springs, from the linearisation alone.
    const Matrix T = sums_and_differences(rotor);
    Matrix M = Matrix::Zero(T.rows(), T.rows()), K = M;
    constexpr int azimuths = 60;
    for (int s = 0; s < azimuths; ++s) {
        const DynamicState at = d.points[1].periodic->at(2 * pi * s / azimuths);
        const SecondOrderSystem system = restrict_to(linearise(rotor.system, at), rotor.unknowns());
        M += T.transpose() * system.M * T / azimuths;
        K += T.transpose() * system.K_elastic * T / azimuths;
    }
    const std::vector<double> share = file.read_doubles("branches/participation");
    const std::vector<Complex> eigenvalue = file.read_complex("branches/eigenvalue");
    double beside = 0;
    for (std::size_t b = 0; b < branches; ++b) {
        CAPTURE(d.branches[b].name);
        for (int j = -8; j <= 8; ++j)  // at standstill there is one shape
            CHECK(share[b * 17 + static_cast<std::size_t>(j + 8)] == (j == 0 ? 1 : 0));
        const FloquetMode& mode = *d.mode(d.branches[b], 1)->floquet;
        const auto energy = [&](Eigen::Index column) {
            const Complex lambda =
                eigenvalue[branches + b] + Complex(0, 2.0 * static_cast<double>(mode.first_harmonic + column));
            const ComplexVector c = mode.harmonics.col(column);
            return (c.adjoint() * (K * c)).value().real() + std::norm(lambda) * (c.adjoint() * (M * c)).value().real();
        };
        double total = 0, inside = 0, sum = 0;
        for (Eigen::Index column = 0; column < mode.harmonics.cols(); ++column) {
            total += energy(column);
            if (std::abs(mode.first_harmonic + column) <= 8) inside += energy(column);
        }
        for (int j = -8; j <= 8; ++j) {
            const double stored_share = share[(branches + b) * 17 + static_cast<std::size_t>(j + 8)];
            const Eigen::Index column = j - mode.first_harmonic;
            const bool there = column >= 0 && column < mode.harmonics.cols();
            CHECK(stored_share == Approx(there ? energy(column) / total : 0).margin(1e-9));
            CHECK(stored_share <= share[(branches + b) * 17 + 8]);  // the principal one holds most
            sum += stored_share;
            if (j != 0) beside = std::max(beside, stored_share);
        }
        CHECK(sum == Approx(inside / total).epsilon(1e-9));
        CHECK(sum > 1 - 1e-6);  // what lies beyond the eighth is not in the file
    }
    CHECK(beside > 1e-3);
}

TEST_CASE("campbell file by Floquet: errors, condition numbers, kinds and the stability margin", "[property]") {
    const SmallRotor rotor = small_rotor({.stiffness = {2000, 2000}, .damping = 6});
    const std::vector<double> speeds{0, 1, 2.5};
    const Campbell d = by_floquet(rotor, speeds, RotorSpin::free);
    const Stored stored(d);
    const Hdf5File& file = *stored.file;
    const std::size_t branches = d.branches.size();
    REQUIRE(branches == 4);  // two flaps, twice the free spin
    const std::vector<double> error = file.read_doubles("branches/eigenvalue_error"),
                              condition = file.read_doubles("branches/condition"),
                              margin = file.read_doubles("stability_margin");
    const std::vector<Complex> eigenvalue = file.read_complex("branches/eigenvalue");
    const std::vector<std::string> kind = file.read_strings("branches/kind"), name = file.read_strings("branches/name"),
                                   pattern = file.read_strings("branches/pattern");
    for (const char* set : {"branches/eigenvalue_error", "branches/condition", "branches/kind"}) {
        CHECK(file.shape(set) == Shape{3, branches});
        CHECK(file.dimension(set, 0) == "/branches/rotor_speed");
        CHECK(file.dimension(set, 1) == "/branches/branch");
    }
    CHECK(file.string_attribute("branches/eigenvalue_error", "units") == "s-1");
    CHECK(file.string_attribute("branches/condition", "units") == "1");
    CHECK(file.string_attribute("stability_margin", "units") == "s-1");
    CHECK(file.dimension("stability_margin", 0) == "/rotor_speed");
    // Closed form of the flaps: decay c / (2 m l^2), w^2 = k / (m l^2) + Omega^2 (1 + e / l) - decay^2.
    const double m = 3, l = 4, e = 0.5, decay = 6 / (2 * m * l * l);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        CHECK(margin[i] == Approx(decay).epsilon(1e-8));
        for (std::size_t b = 0; b < branches; ++b) {
            const std::size_t at = i * branches + b;
            CAPTURE(name[b], speeds[i]);
            if (name[b].starts_with("blade flap")) {
                CHECK(kind[at] == "oscillation");
                CHECK((pattern[b] == "symmetric" || pattern[b] == "antisymmetric"));
                const Complex exact(
                    -decay, std::sqrt(2000 / (m * l * l) + speeds[i] * speeds[i] * (1 + e / l) - decay * decay));
                CHECK(std::abs(eigenvalue[at] - exact) < 1e-8);
                CHECK(std::isnan(error[at]) == (speeds[i] == 0));
                if (speeds[i] == 0) continue;
                // The estimate holds.
                CHECK(std::abs(eigenvalue[at] - exact) < error[at] + 1e-12);
                CHECK(error[at] <= 1e-9 * speeds[i]);
                CHECK(condition[at] >= 0.99);
                CHECK(condition[at] < 100);
            } else {
                CHECK(kind[at] == (speeds[i] == 0 ? "" : "rigid"));
                if (speeds[i] == 0) CHECK(std::isnan(eigenvalue[at].real()));
            }
        }
    }
}

TEST_CASE("campbell file by Floquet: the series of the steady state is the swing of heavy blades", "[analytic]") {
    // Lag hinges in a weak field of gravity -g e_y: m l^2 x'' + c x' + (k + m e l Omega^2) x = -m l g cos psi_k, but
    // for terms of second order in g.
    const double m = 3, l = 4, e = 0.5, k = 2000, c = 300, g = 0.01;
    const SmallRotor rotor =
        small_rotor({.stiffness = {k, k}, .damping = c, .hinges = BladeHinges::lag, .gravity = {0, -g, 0}});
    const std::vector<double> speeds{0, 2, 3};
    const Campbell d = by_floquet(rotor, speeds, RotorSpin::prescribed, 3);
    const Stored stored(d);
    const Hdf5File& file = *stored.file;
    const auto n = static_cast<std::size_t>(rotor.system.model.size());
    REQUIRE(file.shape("steady_state/mean") == Shape{3, n});
    REQUIRE(file.shape("steady_state/cosine") == Shape{3, 3, n});
    REQUIRE(file.shape("steady_state/sine") == Shape{3, 3, n});
    CHECK(file.read_ints("steady_state/harmonic") == std::vector<std::int64_t>{1, 2, 3});
    CHECK(file.string_attribute("steady_state/sine", "units") == "rad or m");
    CHECK(file.dimension("steady_state/sine", 0) == "/steady_state/rotor_speed");
    CHECK(file.dimension("steady_state/sine", 1) == "/steady_state/harmonic");
    CHECK(file.dimension("steady_state/sine", 2) == "/steady_state/coordinate");
    CHECK(file.read_strings("steady_state/unit").at(0) == "rad");
    const std::vector<double> mean = file.read_doubles("steady_state/mean"), q = file.read_doubles("steady_state/q"),
                              cosine = file.read_doubles("steady_state/cosine"),
                              sine = file.read_doubles("steady_state/sine");
    // Mean, cosine 1, sine 1, cosine 2 ...
    const auto coefficient = [&](std::size_t point, std::size_t column, std::size_t coordinate) {
        if (column == 0) return mean[point * n + coordinate];
        return (column % 2 == 1 ? cosine : sine)[(point * 3 + (column - 1) / 2) * n + coordinate];
    };
    for (std::size_t i = 0; i < speeds.size(); ++i)
        for (std::size_t blade : {0U, 1U}) {
            const auto at = static_cast<std::size_t>(rotor.map.blades[blade][0]);
            CAPTURE(speeds[i], blade);
            double sum = coefficient(i, 0, at);
            for (std::size_t j = 1; j <= 3; ++j) sum += coefficient(i, 2 * j - 1, at);
            CHECK(sum == Approx(q[i * n + at]).margin(1e-15));  // at azimuth 0
            const double Omega = speeds[i], sign = blade == 0 ? 1 : -1;
            if (Omega == 0) {  // hangs: k x = -m l g cos x
                CHECK(coefficient(i, 0, at) == Approx(-sign * m * l * g / k).epsilon(1e-4));
                for (std::size_t column = 1; column < 7; ++column) CHECK(coefficient(i, column, at) == 0);
                continue;
            }
            const Complex response =
                -sign * m * l * g / Complex(k + m * e * l * Omega * Omega - m * l * l * Omega * Omega, c * Omega);
            // Re(response e^(i psi)): cosine Re, sine -Im; the next order is by m l g / k ~ 1e-4 less.
            const double small = 2e-4 * std::abs(response);
            CHECK(std::abs(coefficient(i, 1, at) - response.real()) < small);
            CHECK(std::abs(coefficient(i, 2, at) + response.imag()) < small);
            for (const std::size_t column : {0U, 3U, 4U, 5U, 6U}) CHECK(std::abs(coefficient(i, column, at)) < small);
        }
}

TEST_CASE("campbell file: without a periodic steady state it has no harmonics", "[property]") {
    const SmallRotor rotor = small_rotor();
    const double speeds[] = {1.0, 2.0};
    const Campbell d = campbell(rotor.system, rotor.map, speeds);
    const Stored stored(d);
    for (const char* set : {"branches/harmonic", "branches/participation", "branches/condition",
                            "branches/eigenvalue_error", "steady_state/mean", "steady_state/sine", "parameter"})
        CHECK_FALSE(stored.file->has(set));
    CHECK(stored.file->read_doubles("stability_margin").size() == 2);
    CHECK(stored.file->read_strings("branches/kind").size() == 2 * d.branches.size());
}

TEST_CASE("campbell file: another parameter is the axis, with the rotor speeds beside it and without crossings",
          "[property]") {
    std::vector<SmallRotor> rotors;
    const std::vector<double> stiffness{1500, 2000, 4000};
    for (const double k : stiffness) rotors.push_back(small_rotor({.stiffness = {k, k}}));
    std::vector<CampbellCase> cases;
    for (std::size_t i = 0; i < rotors.size(); ++i)
        cases.push_back({&rotors[i].system, &rotors[i].map, 2.0, stiffness[i]});
    CampbellOptions options;
    options.method = CampbellMethod::floquet;
    options.spin = RotorSpin::prescribed;
    const Campbell d = campbell(cases, "stiffness of the hinges, N m/rad", options);
    const Stored stored(d);
    const Hdf5File& file = *stored.file;
    CHECK(file.read_doubles("parameter") == stiffness);
    CHECK(file.string_attribute("parameter", "long_name") == "stiffness of the hinges, N m/rad");
    CHECK(file.string_attribute("parameter", "units") == "N m/rad");
    for (const char* group : {"", "branches", "steady_state"}) {
        const std::string here(group);
        CHECK(file.read_doubles(here + "/parameter") == stiffness);
        CHECK(file.read_doubles(here + "/rotor_speed") == std::vector<double>{2, 2, 2});
        CHECK(file.dimension(here + "/rotor_speed", 0) == (here.empty() ? "" : "/" + here) + "/parameter");
    }
    CHECK(file.dimension("branches/damped_frequency", 0) == "/branches/parameter");
    CHECK(file.string_attribute("branches/damped_frequency", "coordinates") == "rotor_speed name family pattern");
    CHECK_FALSE(file.has("crossings/branch"));
    // w^2 = k / (m l^2) + Omega^2 (1 + e / l)
    const std::vector<double> f = file.read_doubles("branches/damped_frequency");
    REQUIRE(f.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(2 * pi * f[i] == Approx(std::sqrt(stiffness[i / 2] / 48 + 4 * 1.125)).epsilon(1e-9));
}
