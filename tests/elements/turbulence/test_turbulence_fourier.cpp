// Transforms of the turbulence generators against the sums that define them.
#include "elements/turbulence/detail/fourier.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <vector>

using namespace cardan;

TEST_CASE("turbulence: Fourier transforms equal their sums, and undo each other but for the length", "[analytic]") {
    detail::Fourier fourier;
    for (const int n : {2, 3, 8, 30, 97}) {
        const auto size = static_cast<std::size_t>(n);
        std::vector<Complex> in(size), out(size), back(size);
        for (int j = 0; j < n; ++j) in[static_cast<std::size_t>(j)] = Complex(std::sin(j * j), std::cos(3 * j));
        fourier.forward(in.data(), n, out.data());
        fourier.inverse(out.data(), n, back.data());
        double error = 0;
        for (int k = 0; k < n; ++k) {
            Complex sum = 0;
            for (int j = 0; j < n; ++j)
                sum += in[static_cast<std::size_t>(j)] * std::polar(1.0, -2 * pi * (j * k % n) / n);
            error =
                std::max({error, std::abs(out[static_cast<std::size_t>(k)] - sum),
                          std::abs(back[static_cast<std::size_t>(k)] / (1.0 * n) - in[static_cast<std::size_t>(k)])});
        }
        CAPTURE(n);
        CHECK(error < 1e-12);
    }
}

TEST_CASE("turbulence: lengths of transforms are even and have factors of 2, 3 and 5", "[analytic]") {
    const std::pair<int, int> lengths[] = {{1, 2}, {2, 2}, {3, 4}, {7, 8}, {11, 12}, {14, 16}, {61, 64}, {121, 128}};
    for (const auto& [asked, fast] : lengths) CHECK(detail::fast_length(asked) == fast);
    CHECK(detail::largest_factor(12000) == 5);
    CHECK(detail::largest_factor(2 * 101) == 101);
    CHECK(detail::largest_factor(9409) == 97);
}
