/// @file
/// Exceptions. Everything Cardan throws derives from cardan::Error; the message says what, where, the value and the
/// limit.
#pragma once

#include "mbs/base/text.hpp"

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace cardan {

/// Base of all exceptions of the library.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A value or a name that a description must not contain (negative mass, unknown joint, singular metric ...).
class InputError : public Error {
public:
    explicit InputError(const std::string& message) : Error(message) {}
    /// "<where>: <quantity> = <value>; allowed: <allowed>"
    template <class Value>
    InputError(std::string_view where, std::string_view quantity, const Value& value, std::string_view allowed)
        : Error(text(where, ": ", quantity, " = ", value, "; allowed: ", allowed)) {}
};

/// @throws InputError unless the value is finite and > 0 (require_not_negative: >= 0)
inline void require_positive(std::string_view where, std::string_view quantity, double value) {
    if (!(value > 0) || std::isinf(value)) throw InputError(where, quantity, value, "finite and > 0");
}
inline void require_not_negative(std::string_view where, std::string_view quantity, double value) {
    if (!(value >= 0) || std::isinf(value)) throw InputError(where, quantity, value, "finite and >= 0");
}

/// Malformed text: "<file>:<line>:<column>: <message>" (line and column count from 1; column 0 is left out).
class ParseError : public Error {
public:
    ParseError(std::string_view file, int line, int column, std::string_view message)
        : Error(column > 0 ? text(file, ":", line, ":", column, ": ", message) : text(file, ":", line, ": ", message)) {
    }
};

/// A file that cannot be opened, written or completed; the message contains the path and the system's reason.
class FileError : public Error {
public:
    FileError(std::string_view path, std::string_view message) : Error(text(path, ": ", message)) {}
};

/// An allocation failed; the message says what it was for.
class MemoryError : public Error {
public:
    using Error::Error;
};

/// Calls `make`; if it runs out of memory, throws a MemoryError that names what the memory was for.
/// @param what  "the matrix of ...": a text, or a function without arguments, so that the text is built only when
///              needed
template <class What, class Make>
decltype(auto) with_memory(const What& what, Make&& make) {
    const auto refuse = [&]() -> std::string {
        if constexpr (std::is_invocable_v<const What&>)
            return text("not enough memory for ", what());
        else
            return text("not enough memory for ", what);
    };
    try {
        return make();
    } catch (const std::bad_alloc&) {
        throw MemoryError(refuse());
    } catch (const std::length_error&) {  // more than the address space
        throw MemoryError(refuse());
    }
}

/// A computation that has no result: not converged, no constant steady state, singular pencil.
class NumericalError : public Error {
public:
    using Error::Error;
};

}  // namespace cardan
