// Elementary functions of many numbers at once, beside those of the C library one by one.
#include "mbs/base/elementary.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

#include <cmath>
#include <vector>

namespace cardan::testing::elementary_tests {

TEST_CASE("elementary functions: those of the C library, wherever a number stands", "[discrete]") {
    Random random(1);
    for (const std::size_t count : {0U, 1U, 3U, 8U, 19U, 57U}) {
        std::vector<double> x, y, positive, found(count), again(count);
        for (std::size_t i = 0; i < count; ++i) {
            x.push_back(uniform(random, -1.5, 1.5));
            y.push_back(uniform(random, -1, 1));
            positive.push_back(std::pow(10, uniform(random, -4, 4)));
        }
        // Rounding of the vector functions: up to four units of the last place.
        const auto check = [&](const auto& all, const auto& one) {
            all(found, 0);
            for (std::size_t i = 0; i < count; ++i) CHECK(found[i] == Approx(one(i)).epsilon(2e-15).margin(0));
            for (std::size_t first = 0; first < count; ++first) {
                all(again, first);
                for (std::size_t i = first; i < count; ++i) CHECK(again[i - first] == found[i]);
            }
        };
        const auto from = [](const std::vector<double>& all, std::size_t first) {
            return std::span(all).subspan(first);
        };
        check([&](std::vector<double>& out, std::size_t first) { tangents(from(x, first), out); },
              [&](std::size_t i) { return std::tan(x[i]); });
        check([&](std::vector<double>& out, std::size_t first) { arc_tangents(from(y, first), from(x, first), out); },
              [&](std::size_t i) { return std::atan2(y[i], x[i]); });
        check([&](std::vector<double>& out, std::size_t first) { powers(from(positive, first), 0.2, out); },
              [&](std::size_t i) { return std::pow(positive[i], 0.2); });
    }
}

}  // namespace cardan::testing::elementary_tests
