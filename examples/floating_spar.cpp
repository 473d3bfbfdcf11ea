// The NREL 5 MW machine on the OC3-Hywind spar: its frequencies afloat and on a spar that is held, and a decay from
// three degrees of pitch as a history in HDF5.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/outcome.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/solvers/equilibrium/steady_state.hpp>
#include <cardan/solvers/hdf5/history.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/turbines/machines/oc3_hywind.hpp>
#include <cardan/turbines/model/channels.hpp>

#include <iostream>

using namespace cardan;

namespace {

solvers::Campbell modes_at_rest(const turbines::Turbine& turbine) {
    solvers::CampbellOptions options;
    options.max_frequency_hz = 1;
    return solvers::campbell(turbine.system(), turbine.rotor(), std::vector<double>{0}, options);
}

}  // namespace

int main() try {
    const turbines::Turbine afloat = turbines::nrel5mw_on_oc3_hywind(CoordinateRole::free),
                            held = turbines::nrel5mw_on_oc3_hywind(CoordinateRole::driven);
    std::cout << "afloat\n"
              << solvers::table(modes_at_rest(afloat)) << "\nheld\n"
              << solvers::table(modes_at_rest(held));

    const System& system = afloat.system();
    const solvers::SteadyState rest = solvers::steady_state(system, afloat.rotor().spin);
    require_result(rest, "equilibrium");
    Vector q = rest.at.q;
    q(system.model.index("platform pitch")) += 3 * units::degree;
    solvers::Integrator integrator(system, {}, 0, q, Vector::Zero(q.size()));
    solvers::Recorder recorder(integrator, turbines::channels(afloat));
    {
        auto file = solvers::HistoryWriter::create("floating_spar.h5", recorder.channels(),
                                                   {.title = "decay of the spar's pitch"}, {.replace = true});
        require_result(solvers::record(integrator, recorder, solvers::sample_times(0, 120, 0.1), file));
        file.finish();
    }
    solvers::plot(solvers::read_history("floating_spar.h5"),
                  {{{"platform pitch"}}, {{"platform surge", "platform heave"}}, {{"TTDspFA"}}}, "floating_spar.svg");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
