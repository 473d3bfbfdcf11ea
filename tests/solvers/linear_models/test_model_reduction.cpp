// Reduction of linear models: Lyapunov's equation, modal and balanced truncation.
#include "mbs/base/decompositions.hpp"
#include "solvers/linear_models/model_reduction.hpp"
#include "solvers/linear_models/transfer_function.hpp"
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

TEST_CASE("transfer function: in Hessenberg form it is that of the matrices", "[property]") {
    for (const int oscillators : {1, 2, 7, 20}) {
        const ConstantModel model = flexible(7, oscillators, oscillators == 7 ? 1 : 0, 3, 4, 2);
        TransferFunction G(model);
        for (const Complex s :
             {Complex(0, 0.3), Complex(0.2, 0), Complex(0, 1.001), Complex(-3, 40), Complex(0, 1e4)}) {
            const ComplexMatrix plain = model.transfer(s);
            CAPTURE(oscillators, s);
            CHECK((G.at(s) - plain).norm() < 1e-9 * plain.norm());
        }
    }
    ConstantModel none;
    none.A.resize(0, 0), none.B.resize(0, 2), none.C.resize(1, 0);
    none.D = Matrix::Constant(1, 2, 3);
    CHECK(TransferFunction(none).at({0, 1}) == ComplexMatrix::Constant(1, 2, 3));
    ConstantModel integrator;
    integrator.A = integrator.D = Matrix::Zero(1, 1);
    integrator.B = integrator.C = Matrix::Ones(1, 1);
    CHECK_THROWS_AS(TransferFunction(integrator).at(0), NumericalError);
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
    // Scaled to an input ten times as large; the model itself comes back in its own units.
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
    // Either of the two computed magnitudes may be the larger one by rounding.
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

TEST_CASE("balanced truncation by error: no input and no output is further off than was asked, whatever its unit",
          "[property]") {
    for (unsigned seed : {3u, 4u}) {
        ConstantModel model = flexible(seed, 9, 1, 3, 4, 3);  // 1 ... 1000 rad/s
        // What is small in its unit would be lost beside the others.
        model.B.col(1) *= 1e-5;
        model.D.col(1) *= 1e-5;
        model.C.row(2) *= 1e-4;
        model.D.row(2) *= 1e-4;
        constexpr double last = 60 / (2 * pi);  // Hz
        int before = 0;
        for (const double error : {0.3, 0.05, 0.001}) {
            const BalancedModel reduced =
                balanced_truncation(model, {.error = error, .max_frequency_hz = last, .static_gain = StaticGain::kept});
            // Measured here on a grid of its own; the free motion is in both and cancels, so the scale is that of the
            // model without it.
            const ConstantModel rigid = modal_truncation(model, {.keep = {0.0}});
            Matrix off = Matrix::Zero(4, 3), whole = off;
            for (int i = 0; i <= 3000; ++i) {
                const Complex s(0, 2 * pi * last * std::pow(1e-3, 1 - i / 3000.0));
                const ComplexMatrix G = model.transfer(s);
                off = off.cwiseMax((G - reduced.transfer(s)).cwiseAbs());
                whole = whole.cwiseMax((G - rigid.transfer(s) + rigid.D).cwiseAbs());
            }
            const auto worst = [&](const Matrix& difference) {
                // Inputs and outputs at sizes that give them a largest response of one.
                Vector u = Vector::Ones(3), y = Vector::Ones(4);
                for (int round = 0; round < 20; ++round) {
                    y = (whole * u.asDiagonal()).rowwise().maxCoeff();
                    u = (y.cwiseInverse().asDiagonal() * whole).colwise().maxCoeff().cwiseInverse();
                }
                const Matrix scaled = y.cwiseInverse().asDiagonal() * difference * u.asDiagonal(),
                             all = y.cwiseInverse().asDiagonal() * whole * u.asDiagonal();
                const Vector rows = scaled.rowwise().maxCoeff().cwiseQuotient(all.rowwise().maxCoeff());
                const Vector columns =
                    scaled.colwise().maxCoeff().transpose().cwiseQuotient(all.colwise().maxCoeff().transpose());
                return std::max(rows.maxCoeff(), columns.maxCoeff());
            };
            CAPTURE(seed, error, reduced.order, worst(off));
            CHECK(worst(off) < 1.02 * error);
            CHECK(reduced.input_error.maxCoeff() <= error);
            CHECK(reduced.output_error.maxCoeff() <= error);
            CHECK(reduced.order > before);
            before = reduced.order;
            CHECK(reduced.order < 18);
            const std::vector<Complex> poles = reduced.poles();
            CHECK(std::all_of(poles.begin(), poles.end(), [](Complex p) { return p.real() < 1e-4; }));
        }
    }
}

TEST_CASE("balanced truncation by error: a response that is small in its unit is not what is left out", "[analytic]") {
    // Two oscillators, each with an input and an output of its own, G_ii = gain / (s^2 + 2 zeta omega s + omega^2).
    ConstantModel model;
    model.A = Matrix::Zero(4, 4);
    model.B = Matrix::Zero(4, 2);
    model.C = Matrix::Zero(2, 4);
    model.D = Matrix::Zero(2, 2);
    const double omega[2] = {2, 3}, gain[2] = {1, 1e-6}, zeta = 0.02;
    for (int i = 0; i < 2; ++i) {
        const Eigen::Index k = 2 * i;
        model.A.block<2, 2>(k, k) << 0, 1, -omega[i] * omega[i], -2 * zeta * omega[i];
        model.B(k + 1, i) = 1;
        model.C(i, k) = gain[i];
        model.inputs.push_back({text("u", i), "1"});
        model.outputs.push_back({text("y", i), "1"});
    }
    const BalancedModel by_size = balanced_truncation(model, {.tolerance = 1e-3, .max_frequency_hz = 1}),
                        by_error = balanced_truncation(model, {.error = 0.05, .max_frequency_hz = 1});
    CHECK(by_size.order == 2);
    CHECK(by_size.output_error(0) < 1e-10);
    CHECK(by_size.output_error(1) == Approx(1).epsilon(1e-10));  // nothing is left of it
    CHECK(by_error.order == 4);
    const Complex s(0, 3), G = gain[1] / (s * s + 2 * zeta * omega[1] * s + omega[1] * omega[1]);
    CHECK(std::abs(by_error.transfer(s)(1, 1) - G) < 1e-9 * std::abs(G));
}

TEST_CASE("balanced truncation by error: what cannot be asked is refused", "[property]") {
    const ConstantModel model = flexible(3, 4, 0, 1, 1, 2);
    check_refused([&] { balanced_truncation(model, {.error = 0.1}); }, {"largest frequency [Hz] = 0"});
    check_refused([&] { balanced_truncation(model, {.error = -1, .max_frequency_hz = 1}); }, {"error = -1"});
    check_refused([&] { balanced_truncation(model, {.error = std::nan(""), .max_frequency_hz = 1}); }, {"error = nan"});
    check_refused([&] { balanced_truncation(model, {.order = 3, .error = 0.1, .max_frequency_hz = 1}); }, {"order"});
    CHECK_THROWS_AS(balanced_truncation(model, {.error = 1e-30, .max_frequency_hz = 1}), NumericalError);
}
