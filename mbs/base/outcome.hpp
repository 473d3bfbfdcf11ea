/// @file
/// Outcome of a computation that may fail to converge: every such result carries one.
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

/// Throws unless the result converged, for callers who cannot go on without it.
/// @throws NumericalError with the message unless it converged
inline void require_result(const Outcome& outcome) {
    if (!outcome.converged) throw NumericalError(outcome.message);
}
/// Throws "<where>: <message>" unless the result converged.
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
