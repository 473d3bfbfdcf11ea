#include "tests/oracles/euler_bernoulli.hpp"

#include "tests/oracles/root_finding.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles::euler_bernoulli {
namespace {

constexpr double pi = std::numbers::pi;

void require_mode(int mode) {
    if (mode < 1) throw std::invalid_argument("euler_bernoulli: modes are counted from 1");
}

/// cosh(beta xi) - sigma sinh(beta xi) with 1 - sigma given: no cancellation of large exponentials.
double decaying_part(double beta, double one_minus_sigma, double xi) {
    return std::exp(-beta * xi) + one_minus_sigma * std::sinh(beta * xi);
}

}  // namespace

double cantilever_wave_number(int mode) {
    require_mode(mode);
    return bisect([](double b) { return std::cos(b) + 1.0 / std::cosh(b); }, (mode - 1) * pi, mode * pi);
}

double cantilever_frequency(int mode) {
    const double beta = cantilever_wave_number(mode);
    return beta * beta;
}

double cantilever_shape(int mode, double xi) {
    const double b = cantilever_wave_number(mode);
    const double one_minus_sigma = (std::sin(b) - std::cos(b) - std::exp(-b)) / (std::sinh(b) + std::sin(b));
    const double sigma = 1.0 - one_minus_sigma;
    const auto shape = [&](double s) {
        return decaying_part(b, one_minus_sigma, s) - std::cos(b * s) + sigma * std::sin(b * s);
    };
    return shape(xi) / shape(1.0);
}

double free_free_wave_number(int mode) {
    require_mode(mode);
    return bisect([](double b) { return std::cos(b) - 1.0 / std::cosh(b); }, mode * pi, (mode + 1) * pi);
}

double free_free_frequency(int mode) {
    const double beta = free_free_wave_number(mode);
    return beta * beta;
}

double free_free_shape(int mode, double xi) {
    const double b = free_free_wave_number(mode);
    const double one_minus_sigma = (std::cos(b) - std::sin(b) - std::exp(-b)) / (std::sinh(b) - std::sin(b));
    const double sigma = 1.0 - one_minus_sigma;
    const auto shape = [&](double s) {
        return decaying_part(b, one_minus_sigma, s) + std::cos(b * s) - sigma * std::sin(b * s);
    };
    return shape(xi) / shape(1.0);
}

}  // namespace cardan::oracles::euler_bernoulli
