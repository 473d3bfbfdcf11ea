// Reduction of linear models: Lyapunov's equation, modal and balanced truncation.
#include "mbs/decompositions.hpp"
#include "solvers/model_reduction.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

Matrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
    Matrix A(rows, columns);
    for (Eigen::Index j = 0; j < columns; ++j)
        for (Eigen::Index i = 0; i < rows; ++i) A(i, j) = uniform(random, -1, 1);
    return A;
}

// Weakly damped oscillators from 1 rad/s over some decades in mixed coordinates, and `free` double poles at zero.
ConstantModel flexible(unsigned seed, int oscillators, int free, Eigen::Index inputs, Eigen::Index outputs,
                       double decades = 4) {
    Random random(seed);
    const Eigen::Index n = oscillators + free;
    Matrix A = Matrix::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    for (int i = 0; i < oscillators; ++i) {
        const double omega = std::pow(10, decades * i / std::max(1, oscillators - 1)), zeta = 0.01 + 0.02 * i;
        A(n + i, i) = -omega * omega;
        A(n + i, n + i) = -2 * zeta * omega;
    }
    ConstantModel model;
    const Matrix mixed = Matrix::Identity(n, n) + 0.3 * random_matrix(random, n, n);
    Matrix V = Matrix::Zero(2 * n, 2 * n);
    V.topLeftCorner(n, n) = V.bottomRightCorner(n, n) = mixed;
    const Matrix V_inverse = V.inverse();
    model.A = V_inverse * A * V;
    Matrix B = Matrix::Zero(2 * n, inputs);
    B.bottomRows(n) = random_matrix(random, n, inputs);
    model.B = V_inverse * B;
    model.C = random_matrix(random, outputs, 2 * n) * V;
    model.C.rightCols(n) *= 0.1;
    model.D = random_matrix(random, outputs, inputs);
    for (Eigen::Index i = 0; i < inputs; ++i) model.inputs.push_back({text("u", i), "1"});
    for (Eigen::Index i = 0; i < outputs; ++i) model.outputs.push_back({text("y", i), "1"});
    return model;
}

double largest_singular_value(const ComplexMatrix& G) {
    return Eigen::JacobiSVD<ComplexMatrix>(G).singularValues()(0);
}

// Largest difference between two models at many frequencies, those of the poles among them.
double largest_difference(const ConstantModel& a, const ConstantModel& b) {
    std::vector<double> frequencies;
    for (int i = 0; i <= 240; ++i) frequencies.push_back(std::pow(10, -1 + 6.0 * i / 240));
    for (const ConstantModel* model : {&a, &b})
        for (const Complex& pole : model->poles())
            if (std::abs(pole) > 1e-3) frequencies.push_back(std::abs(pole.imag()));
    double largest = 0;
    for (double omega : frequencies) {
        const Complex s(0, omega);
        if (omega > 0) largest = std::max(largest, largest_singular_value(a.transfer(s) - b.transfer(s)));
    }
    return largest;
}

}  // namespace

TEST_CASE("Lyapunov's equation: one and two states by hand", "[analytic]") {
    // a x + x a + q = 0
    CHECK(lyapunov(Matrix::Constant(1, 1, -3), Matrix::Constant(1, 1, 12))(0, 0) == Approx(2).epsilon(1e-14));
    // Oscillator under white noise on its velocity: x11 = q / (4 zeta omega^3), x22 = q / (4 zeta omega), x12 = 0.
    const double omega = 5, zeta = 0.02, q = 3;
    const Matrix A = (Matrix(2, 2) << 0, 1, -omega * omega, -2 * zeta * omega).finished();
    const Matrix X = lyapunov(A, (Matrix(2, 2) << 0, 0, 0, q).finished());
    CHECK(X(0, 0) == Approx(q / (4 * zeta * omega * omega * omega)).epsilon(1e-12));
    CHECK(X(1, 1) == Approx(q / (4 * zeta * omega)).epsilon(1e-12));
    CHECK(std::abs(X(0, 1)) < 1e-12 * X(1, 1));
}

TEST_CASE("Lyapunov's equation: residual of random stable matrices", "[property]") {
    for (unsigned seed : {1u, 2u, 3u}) {
        Random random(seed);
        Matrix A = random_matrix(random, 13, 13);
        A.diagonal().array() -= 4;
        const Matrix root = random_matrix(random, 13, 4), Q = root * root.transpose();
        const Matrix X = lyapunov(A, Q);
        CHECK((A * X + X * A.transpose() + Q).norm() < 1e-12 * (A.norm() * X.norm() + Q.norm()));
    }
}

TEST_CASE("modal truncation: keeps poles and residues of what it keeps, and the static gain on demand", "[property]") {
    const ConstantModel model = flexible(7, 6, 1, 2, 3);  // 0, 1, 6.3, 40, 251 ... rad/s
    ModalOptions options;
    options.max_frequency_hz = 50 / (2 * pi);
    const ConstantModel low = modal_truncation(model, options);
    REQUIRE(low.A.rows() == 8);
    CHECK(low.outputs.size() == 3);
    CHECK(low.states.size() == 8);
    const auto all = model.poles(), kept = low.poles();
    for (std::size_t i = 2; i < 8; ++i) CHECK(std::abs(all[i] - kept[i]) < 1e-7 * std::abs(kept[i]));
    // What is left out and what is kept add up to the model.
    ModalOptions others;
    others.keep = {all[8], all[10], all[12]};
    const ConstantModel high = modal_truncation(model, others);
    const Complex s(0.3, 2);
    const ComplexMatrix whole = model.transfer(s);
    ModalOptions free_only;
    free_only.keep = {0.0};
    const ConstantModel rigid = modal_truncation(model, free_only);
    REQUIRE(rigid.A.rows() == 2);
    const ComplexMatrix sum = low.transfer(s) + high.transfer(s) - rigid.transfer(s);
    CHECK((sum - whole).norm() < 1e-7 * whole.norm());

    const ConstantModel stable = flexible(8, 6, 0, 2, 3);
    const ComplexMatrix gain = stable.transfer(0);
    CHECK((modal_truncation(stable, options).transfer(0) - gain).norm() > 1e-7 * gain.norm());
    options.static_gain = StaticGain::kept;
    CHECK((modal_truncation(stable, options).transfer(0) - gain).norm() < 1e-9 * gain.norm());
    // The listed ones only: the pair next to 40 rad/s, and the free motion.
    ModalOptions listed;
    listed.keep = {{0, 40}};
    const ConstantModel one = modal_truncation(model, listed);
    REQUIRE(one.A.rows() == 4);
    CHECK(std::abs(one.poles()[2]) == Approx(std::pow(10, 1.6)).epsilon(1e-9));
    CHECK(one.poles()[2].imag() == -one.poles()[3].imag());
}

TEST_CASE("balanced truncation: the error stays below twice the sum of the Hankel values left out", "[analytic]") {
    for (unsigned seed : {11u, 12u})
        for (StaticGain gain : {StaticGain::free, StaticGain::kept}) {
            const ConstantModel model = flexible(seed, 8, seed == 12 ? 1 : 0, 2, 2, 2.5);
            for (int order : {4, 8, 12}) {
                BalancedOptions options;
                options.order = order;
                options.static_gain = gain;
                const BalancedModel reduced = balanced_truncation(model, options);
                CHECK(reduced.kept_as_is == (seed == 12 ? 2 : 0));
                REQUIRE(reduced.A.rows() == order + reduced.kept_as_is);
                const double error = largest_difference(model, reduced);
                CAPTURE(seed, order, error, reduced.error_bound, reduced.hankel.transpose());
                // Rounding of transfer functions beside the largest Hankel value.
                CHECK(error < reduced.error_bound + 1e-9 * reduced.hankel(0));
                // Not below the first value left out: no model of this order is better.          [Glover 1984]
                if (reduced.hankel(order) > 1e-6 * reduced.hankel(0)) CHECK(error > 0.9 * reduced.hankel(order));
            }
        }
}

TEST_CASE("balanced truncation: Hankel values of one state by hand, static gain kept exactly", "[analytic]") {
    ConstantModel one;
    one.A = Matrix::Constant(1, 1, -2);
    one.B = Matrix::Constant(1, 1, 3);
    one.C = Matrix::Constant(1, 1, 5);
    one.D = Matrix::Zero(1, 1);
    CHECK(balanced_truncation(one).hankel(0) == Approx(3.0 * 5 / (2 * 2)).epsilon(1e-13));
    // Of 1 in a unit that is ten times as large; the model itself comes back in its own units.
    BalancedOptions scaled;
    scaled.input_size = Vector::Constant(1, 10);
    const BalancedModel same = balanced_truncation(one, scaled);
    CHECK(same.hankel(0) == Approx(10 * 3.0 * 5 / (2 * 2)).epsilon(1e-13));
    CHECK(std::abs(same.transfer({0, 1})(0, 0) - 15.0 / Complex(2, 1)) < 1e-13);

    const ConstantModel model = flexible(5, 7, 0, 2, 3);
    BalancedOptions options;
    options.order = 5;
    options.static_gain = StaticGain::kept;
    const BalancedModel kept = balanced_truncation(model, options);
    options.static_gain = StaticGain::free;
    const BalancedModel lost = balanced_truncation(model, options);
    const ComplexMatrix exact = model.transfer(0);
    CHECK((kept.transfer(0) - exact).norm() < 1e-9 * exact.norm());
    CHECK((lost.transfer(0) - exact).norm() > 1e-9 * exact.norm());
    CHECK(lost.D == model.D);
}

TEST_CASE("modal truncation: a limit at a natural frequency keeps or leaves both poles of the pair", "[property]") {
    // Of the two computed magnitudes either may be the larger one by rounding.
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const ConstantModel model = flexible(seed, 4, 0, 1, 1, 1);
        const std::vector<Complex> poles = model.poles();
        ModalOptions options;
        options.max_frequency_hz = std::abs(poles[seed % 2 == 0 ? 2 : 3]) / (2 * pi);
        const ConstantModel low = modal_truncation(model, options);
        CAPTURE(seed);
        REQUIRE(low.A.rows() % 2 == 0);
        const std::vector<Complex> kept = low.poles();
        for (std::size_t i = 0; i < kept.size(); ++i) CHECK(std::abs(kept[i] - poles[i]) < 1e-9 * std::abs(kept[i]));
    }
}

TEST_CASE("reduction: bad input is refused", "[property]") {
    const ConstantModel model = flexible(1, 2, 0, 1, 1);
    for (const auto& reduce :
         {std::function<void(const ConstantModel&)>(
              [](const ConstantModel& m) { (void)modal_truncation(m, {.max_frequency_hz = 1, .keep = {1.0}}); }),
          std::function<void(const ConstantModel&)>([](const ConstantModel& m) { (void)balanced_truncation(m); })}) {
        ConstantModel wrong;
        wrong.B.resize(0, 1), wrong.C.resize(1, 0), wrong.D = Matrix::Ones(1, 1);
        check_refused([&] { reduce(wrong); }, {"number of states = 0"});
        for (Matrix StateMatrices::*m : {&StateMatrices::A, &StateMatrices::B, &StateMatrices::C, &StateMatrices::D}) {
            wrong = model;
            (wrong.*m)(0, 0) = std::nan("");
            check_refused([&] { reduce(wrong); }, {"not finite"});
        }
        wrong = model;
        wrong.C.resize(1, 3);
        check_refused([&] { reduce(wrong); }, {"sizes of A, B, C, D = 4 x 4, 4 x 1, 1 x 3, 1 x 1"});
    }
    check_refused([&] { (void)modal_truncation(model, {.max_frequency_hz = -1}); }, {"frequency", "-1"});
    check_refused([&] { (void)modal_truncation(model, {.max_frequency_hz = 1e-3}); }, {"keeps a mode"});
    check_refused([&] { (void)balanced_truncation(model, {.order = 5}); }, {"order = 5", "0 ... 4"});
    check_refused([&] { (void)balanced_truncation(model, {.tolerance = 1}); }, {"tolerance = 1"});
    check_refused([&] { (void)balanced_truncation(model, {.input_size = Vector::Ones(2)}); }, {"sizes of inputs = 2"});
    check_refused([&] { (void)balanced_truncation(model, {.output_size = Vector::Zero(1)}); }, {"outputs = 0"});
    check_refused([&] { (void)lyapunov(model.A, Matrix::Zero(1, 1)); }, {"sizes of A and Q"});
    CHECK_THROWS_AS(lyapunov(Matrix::Identity(2, 2), Matrix::Identity(2, 2)), NumericalError);
}
