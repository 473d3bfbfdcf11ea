// How many elements does a beam need? Errors of the joint chain beside other elements.
//
// Problem: beams whose answers are known (frequencies at rest and in rotation, critical loads, large deflections, two
// blades) are computed with N = 1 ... 32 elements by cardanic elements with several partitions, by cubic Hermite
// elements with consistent matrices and by the mixed geometrically exact element; the error over N shows constant and
// order of each, error ~ C / N^order.
// Reference: closed forms and digits of docs/verification.md; where there are none, Hermite elements with all breaks as
// nodes, extrapolated, in extended precision (docs/beam_accuracy.md). A list of orders and errors is checked.
#include "examples/studies/beam_accuracy/figure.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "programs/shared/program.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>

using namespace cardan;
using namespace cardan::accuracy;

namespace {

struct Arguments {
    std::vector<std::string> names;
    std::filesystem::path out = ".";
    bool list = false;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Errors of beam elements over their number.\n"
        "Prints tables and a check list, computed | reference | error, and writes DIR/beam_accuracy_CASE.csv and "
        "DIR/beam_*.svg, .png.");
    app.footer("Exit code: 0; 1 error; 2 wrong usage; 3 a check fails; 130 interrupted (finished cases are kept).");
    app.add_option("--case", a.names, "cases to run (default: all)");
    app.add_option("--out", a.out, "folder of the files");
    app.add_flag("--list", a.list, "print the cases and end");
    return app.parse(argc, argv);
}

std::vector<Case> chosen(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (std::none_of(cases().begin(), cases().end(), [&](const Case& c) { return c.name == name; }))
            throw InputError("--case", "value", name, "the names that --list prints");
    std::vector<Case> result;
    for (const Case& c : cases())
        if (names.empty() || std::find(names.begin(), names.end(), c.name) != names.end()) result.push_back(c);
    return result;
}

// A line that is overwritten.
bool progress(const std::string& what) {
    program::progress("\r\033[K" + what);
    return !program::interrupted();
}

int run(const Arguments& a) {
    if (a.list) {
        for (const Case& c : cases()) std::cout << c.name << ": " << c.what << "\n";
        return 0;
    }
    if (std::error_code code; !std::filesystem::is_directory(a.out, code))
        throw FileError(a.out.string(), text("the folder '", a.out.string(), "' does not exist"));
    std::vector<Result> results;
    int failures = 0;
    for (const Case& c : chosen(a.names)) {
        progress(c.name + ", reference");
        Result result;
        if (!accuracy::run(c.make(), result, progress)) {
            progress("");
            std::cerr << "interrupted; files of the cases before " << c.name << " are complete\n";
            return 130;
        }
        progress("");
        print(result, std::cout);
        failures += check(result, std::cout);
        if (!std::cout.flush()) throw FileError("standard output", "the table could not be written");
        write_file(a.out / ("beam_accuracy_" + c.name + ".csv"), csv(result));
        results.push_back(std::move(result));
    }
    program::stop_at_once();
    for (const Figure& figure : figures())
        if (complete(figure, results))
            for (const char* ending : {".svg", ".png"}) draw(figure, results, a.out / (figure.name + ending));
    std::cout << "\nfiles: beam_accuracy_*.csv and figures in " << a.out.string() << "\n"
              << (failures == 0 ? "all checks hold" : text("checks that FAILED: ", failures)) << "\n";
    return failures == 0 ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("beam_accuracy", argc, argv, parse, run);
}
