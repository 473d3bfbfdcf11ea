/// @file
/// Input that must be refused: the message has to say what, where and which value.
#pragma once

#include "mbs/base/error.hpp"
#include "tests/support/catch.hpp"

#include <initializer_list>
#include <string>

namespace cardan::testing {

/// The message of the InputError that `call` throws; "(accepted)" if it throws none.
template <class Call>
std::string refusal(Call&& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

/// Checks that `call` throws InputError and that the message contains all `parts`.
template <class Call>
void check_refused(Call&& call, std::initializer_list<std::string> parts) {
    const std::string message = refusal(call);
    CHECK(message != "(accepted)");
    for (const std::string& part : parts) {
        CAPTURE(message, part);
        CHECK(message.find(part) != std::string::npos);
    }
}

}  // namespace cardan::testing
