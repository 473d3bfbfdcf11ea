/// @file
/// Common parts of short studies with one picture.
#pragma once

#include "programs/shared/program.hpp"

#include <cstdio>

namespace cardan::program {

/// The command line of a study, with --out for its picture, and its errors.
class Study {
public:
    /// @param name  of the program; its picture is "<name>.svg" unless given otherwise
    Study(std::string name, const std::string& about)
        : picture(name + ".svg"),
          line(about + "\nPrints what is computed beside its reference."),
          name_(std::move(name)) {
        line.add_option("--out", picture, "picture: .svg, .png or .pdf").type_name("FILE");
    }
    /// @return exit code
    template <class Body>
    int run(int argc, char** argv, const Body& body) {
        return with_errors(name_.c_str(), [&] {
            if (const int code = line.parse(argc, argv); code >= 0) return code;
            body();
            return 0;
        });
    }

    std::string picture;
    CommandLine line;

private:
    std::string name_;
};

/// Heads the columns of compare().
/// @param source  of the reference
inline void compare_with(const std::string& source) {
    std::printf("\nreference: %s\n%-32s %16s %16s %12s\n", source.c_str(), "", "computed", "reference", "difference");
}

/// "what  computed  reference  difference".
/// @param digits  behind the point, as many as the reference has
inline void compare(const std::string& what, double computed, double reference, int digits) {
    std::printf("%-32s %16.*f %16.*f %12.1e\n", what.c_str(), digits, computed, digits, reference,
                computed - reference);
}

}  // namespace cardan::program
