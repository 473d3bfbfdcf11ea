/// @file
/// Remarks of the library on the terminal.
#pragma once

#include "programs/shared/option_names.hpp"
#include "programs/shared/program.hpp"
#include "turbines/analysis/remark.hpp"

#include <iostream>
#include <string>

namespace cardan::program {

/// Prints a remark with options in the place of fields. Entries of files are left out: print_notes() has them.
inline void print_remark(const turbines::Remark& remark) {
    using Kind = turbines::Remark::Kind;
    const std::string words = in_options(remark.text);
    clear_progress();
    switch (remark.kind) {
        case Kind::taken:
            std::cout << words << "\n";
            return;
        case Kind::note:
            std::cout << "note: " << words << "\n";
            return;
        case Kind::warning:
            std::cerr << "warning: " << words << "\n";
            return;
        case Kind::controller:
            std::cout << "controller: at " << remark.time << " s: " << words << "\n";
            return;
        case Kind::file:
            return;
    }
}

}  // namespace cardan::program
