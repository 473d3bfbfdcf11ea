/// @file
/// A convergence study: some quantities of one problem by several methods over the number of elements.
#pragma once

#include "examples/studies/beam_accuracy/method.hpp"

#include <functional>
#include <iosfwd>

namespace cardan::accuracy {

struct Quantity {
    std::string name;
    double reference;    ///< 0: the values are relative errors already
    std::string source;  ///< of the reference
};

/// Check of a run's result; the program says so and fails if it does not.
struct Check {
    enum class Kind : std::uint8_t { order, error };
    Kind kind;
    std::string method;
    std::size_t quantity;
    int elements;      ///< an order is that from half as many
    double expected;   ///< order, or error in %
    double tolerance;  ///< absolute for orders, relative for errors
};

struct Study {
    std::string name, title;
    std::vector<Quantity> quantities = {};
    std::vector<std::string> methods = {};
    std::vector<int> elements{1, 2, 3, 4, 6, 8, 12, 16, 32};
    /// One value per quantity, NaN for none. Refusals are thrown as Error.
    std::function<std::vector<double>(const Method&, int elements)> compute = {};
    std::vector<Check> checks = {};
    std::string note = {};
    int mixed_elements = 16;  ///< largest number for the mixed element, whose unknowns are many
};

struct Case {
    std::string name, what;
    Study (*make)();
};
const std::vector<Case>& cases();

/// Relative errors of a study; NaN where there is no value.
struct Result {
    Study study;
    std::vector<std::vector<std::vector<double>>> value, error;  ///< by method, quantity, place in study.elements
    std::vector<std::string> refusals;                           ///< what a method said, once each

    /// Observed order between one number of elements and the one before it; NaN below the floor of precision.
    double order(std::size_t method, std::size_t quantity, std::size_t place, std::size_t before) const;
};

/// Errors below this (relative) are rounding.
inline constexpr double floor_of_precision = 2e-10;

/// @param progress  called before every value; false stops the run
/// @return false if it was stopped
bool run(const Study& study, Result& result, const std::function<bool(const std::string&)>& progress);

void print(const Result& result, std::ostream& out);
std::string csv(const Result& result);
/// Prints the check list. @return the number of failures
int check(const Result& result, std::ostream& out);

}  // namespace cardan::accuracy
