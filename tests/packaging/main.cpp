// Uses the installed headers and libraries as a stranger would.
#include "mbs/error.hpp"
#include "mbs/version.hpp"

#include <iostream>

int main() {
    try {
        throw cardan::InputError("body 'blade'", "mass", -1.0, ">= 0 kg");
    } catch (const cardan::Error& error) {
        std::cout << "cardan " << cardan::version() << ": " << error.what() << '\n';
    }
    return 0;
}
