#include "examples/studies/nrel5mw_assumed_modes/functions.hpp"

#include "mbs/base/error.hpp"

namespace cardan::paper2018 {

namespace {

constexpr int max_pieces = 48;  // as many as there are from station to station

void check(const char* option, const char* what, int value, int min, int max) {
    if (value < min || value > max) throw InputError(option, what, value, text(min, " ... ", max));
}

}  // namespace

bool Functions::are_of_the_paper() const {
    const Functions paper;
    return bending == paper.bending && torsion == paper.torsion && torsion_by == paper.torsion_by &&
           pieces == paper.pieces;
}

std::string Functions::description() const {
    const std::string each = pieces == 1   ? ""
                             : pieces == 0 ? " from station to station"
                                           : text(" on each of ", pieces, " equal pieces");
    return text(bending, " polynomials for v and w each", each, ", ", torsion, " ", torsion_by, " for torsion",
                torsion_by == "sines" ? "" : each);
}

AssumedModesBasis Functions::basis(double length) const {
    const bool sines = torsion_by == "sines";
    check("--bending", "polynomials per piece", bending, 2, 9);
    check("--torsion", sines ? "sines" : "polynomials per piece", torsion, 1, sines ? 40 : 9);
    check("--pieces", "number", pieces, 0, max_pieces);
    AssumedModesBasis basis{.bending = bending, .torsion = torsion, .extension = 0, .sines = sines};
    for (int i = 0; i < pieces; ++i) basis.breaks.push_back(length * i / pieces);
    if (pieces > 0) basis.breaks.push_back(length);
    return basis;
}

void add_options(program::CommandLine& app, Functions& functions) {
    app.add_option("--bending", functions.bending,
                   "in place of the paper's functions: polynomials per piece for each deflection, 2 ... 9; on one "
                   "piece (x/L)^2, (x/L)^3 ...");
    app.add_option("--torsion", functions.torsion,
                   "in place of the paper's: sines, 1 ... 40, or polynomials per piece, 1 ... 9");
    app.add_option("--torsion-by", functions.torsion_by, "functions of torsion").one_of({"sines", "polynomials"});
    app.add_option("--pieces", functions.pieces,
                   "equal pieces of the length for the polynomials, 1 ... 48; 0: from station to station of the table");
}

}  // namespace cardan::paper2018
