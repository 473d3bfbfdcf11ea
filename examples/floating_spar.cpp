// The NREL 5 MW machine on the OC3-Hywind spar: its frequencies afloat and on a spar that is held, and a decay from
// three degrees of pitch, rotor locked, as a history in HDF5 and a picture.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/solvers/equilibrium/steady_state.hpp>
#include <cardan/solvers/hdf5/history.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/turbines/model/channels.hpp>
#include <cardan/turbines/reference_turbines/oc3_hywind.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

solvers::Campbell modes_at_rest(const turbines::Turbine& turbine) {
    solvers::CampbellOptions options;
    options.spin = solvers::RotorSpin::prescribed;
    options.max_frequency_hz = 0.6;
    return solvers::campbell(turbine.system(), turbine.rotor(), std::vector<double>{0}, options);
}

int main() try {
    const turbines::Turbine afloat = turbines::nrel5mw_on_oc3_hywind(CoordinateRole::free),
                            held = turbines::nrel5mw_on_oc3_hywind(CoordinateRole::prescribed);
    std::cout << "afloat\n"
              << solvers::table(modes_at_rest(afloat)) << "\nheld\n"
              << solvers::table(modes_at_rest(held));

    const System& system = afloat.system();
    const solvers::SteadyState rest = solvers::steady_state(system, afloat.rotor().spin);
    require_result(rest, "equilibrium");
    const int pitch = system.model.index("platform pitch");
    Vector q = rest.at.q;
    q(pitch) += 3 * units::degree;
    solvers::Integrator motion(system, {{afloat.rotor().spin, solvers::Motion::constant(0)}}, 0, q,
                               Vector::Zero(q.size()));
    solvers::Recorder recorder(motion, turbines::channels(afloat));
    auto file = solvers::HistoryWriter::create("floating_spar.h5", recorder.channels(),
                                               {.title = "Decay of the spar's pitch"}, {.replace = true});
    require_result(solvers::record(motion, recorder, solvers::sample_times(0, 100, 0.1), file));
    file.finish();

    const solvers::History history = solvers::read_history("floating_spar.h5");
    const std::vector<double>&t = history.time, &angle = history["platform pitch"];
    std::vector<double> falls;  // through the equilibrium, s
    for (std::size_t i = 1; i < t.size(); ++i)
        if (const double before = angle[i - 1] - rest.at.q(pitch), now = angle[i] - rest.at.q(pitch);
            before > 0 && now <= 0)
            falls.push_back((t[i - 1] * now - t[i] * before) / (now - before));
    std::printf("\nperiod of the pitch %.3f s\n",
                (falls.back() - falls.front()) / static_cast<double>(falls.size() - 1));
    solvers::plot(history, {{{"platform pitch"}}, {{"platform surge", "platform heave"}}, {{"TTDspFA"}}},
                  "floating_spar.svg");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
