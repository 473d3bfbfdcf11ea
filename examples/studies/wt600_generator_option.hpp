/// @file
/// The option --generator of the programs that linearise the 600 kW machine.
#pragma once

#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "turbines/machines/wt600_operation.hpp"
#include "turbines/model/generator_slip.hpp"

#include "programs/shared/command_line.hpp"
#include <string>

namespace cardan::program {

struct GeneratorOption {
    std::string kind = "free";
    double torque = 0;  ///< N m, where its slip is linearised

    solvers::RotorSpin spin() const {
        return kind == "locked" ? solvers::RotorSpin::prescribed : solvers::RotorSpin::free;
    }
};

inline void add_generator_option(CommandLine& app, GeneratorOption& option) {
    app.add_option("--generator", option.kind,
                   "free: no torque; slip: the data set's induction machine, linearised; locked: its speed prescribed")
        .one_of({"free", "slip", "locked"});
    app.add_option("--generator-torque", option.torque, "of the induction machine where its slip is linearised, N m");
}

/// @param data  folder of the data set; empty: built in
/// @throws InputError, FileError, ParseError
inline turbines::Turbine with_generator(const turbines::Turbine& turbine, const GeneratorOption& option,
                                        const std::string& data) {
    if (option.kind != "slip") {
        if (option.torque != 0)
            throw InputError("--generator-torque", "value [N m]", option.torque, "0, or --generator slip");
        return turbine;
    }
    return turbines::with_generator_slip(
        turbine, data.empty() ? turbines::wt600_induction_machine() : turbines::wt600_induction_machine(data),
        option.torque);
}

}  // namespace cardan::program
