// Uniform cantilevers spinning about their root, mass on a line.
#include "examples/studies/beam_accuracy/cases.hpp"
#include "examples/studies/beam_accuracy/chain.hpp"
#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

using enum Check::Kind;

// Exact to eight digits: Wright, Smith, Thresher and Wang 1982 and docs/verification.md. The limits computed here must
// meet them; they have the digits that fine elements need. of_k: error of K in flap 1 with four elements, %.
Study rotating(const std::string& name, double eta, double flap1, double flap2, double lag1, double of_k) {
    const BeamLine line = uniform_beam(1, slender());
    Study s{name, text("uniform cantilever, hub radius 0, eta = Omega sqrt(mu L^4/EI) = ", eta)};
    const BendingModes flap = hermite_limit({line, Plane::flap, eta}), edge = hermite_limit({line, Plane::edge, eta});
    const auto known = [&](const char* what, double limit, double published) {
        if (std::abs(limit - published) > 6e-8)
            throw NumericalError(text(name, ", ", what, ": limit ", limit, " against ", published));
        s.quantities.push_back({what, limit, text("Hermite, extrapolated; power series ", published)});
    };
    known("flap 1", flap.flap.at(0), flap1);
    known("flap 2", flap.flap.at(1), flap2);
    known("lag 1", edge.edge.at(0), lag1);
    s.methods = {"G", "S", "K", "Sa", "Hermite", "mixed"};
    s.compute = [line, eta](const Method& method, int n) -> std::vector<double> {
        std::vector<double> f = bending_modes(method, {line, Plane::flap, eta}, equal_ends(1, n)).flap;
        f.resize(2, std::nan(""));
        const std::vector<double> e = bending_modes(method, {line, Plane::edge, eta}, equal_ends(1, n)).edge;
        return {f[0], f[1], e.at(0)};
    };
    s.checks = {{order, "G", 0, 32, 2, 0.1},     {order, "G", 2, 32, 2, 0.1},       {order, "S", 0, 32, 4, 0.1},
                {order, "S", 2, 32, 4, 0.1},     {order, "Hermite", 0, 32, 4, 0.1}, {order, "Hermite", 2, 32, 4, 0.1},
                {order, "mixed", 0, 16, 2, 0.1}, {order, "K", 0, 32, 4, 0.1},       {order, "K", 2, 32, 4, 0.1},
                {error, "K", 0, 4, of_k, 0.01}};
    return s;
}

}  // namespace

Study rotating_slowly() {
    return rotating("eta3", 3, 4.7972785, 23.3202637, 3.7435119, 0.00744);
}

Study rotating_fast() {
    return rotating("eta12", 12, 13.1701505, 37.6031123, 5.4270493, 0.216);
}

}  // namespace cardan::accuracy
