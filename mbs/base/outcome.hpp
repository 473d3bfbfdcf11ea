/// @file
/// What every result carries that a computation may fail to reach.
#pragma once

#include "mbs/base/error.hpp"

#include <string>
#include <type_traits>

namespace cardan {

/// Base of such results. If it did not converge, the rest of the result is what was reached.
struct Outcome {
    bool converged = false;
    std::string message = {};  ///< why it did not converge and what to do, empty if it did
};

/// For those who cannot go on without the result.
/// @throws NumericalError with the message unless it converged
inline void require_result(const Outcome& outcome) {
    if (!outcome.converged) throw NumericalError(outcome.message);
}
/// Likewise: "<where>: <message>".
/// @param where  a text, or a function without arguments, so that the text is built only when needed
template <class Where>
void require_result(const Outcome& outcome, const Where& where) {
    if (outcome.converged) return;
    if constexpr (std::is_invocable_v<const Where&>)
        throw NumericalError(text(where(), ": ", outcome.message));
    else
        throw NumericalError(text(where, ": ", outcome.message));
}

}  // namespace cardan
