/// @file
/// A run in time on its way to a file: options, rows with checkpoints, how to go on, pictures.
#pragma once

#include "mbs/base/error.hpp"
#include "turbines/model/description_text.hpp"

#include "programs/shared/simulation.hpp"
#include <algorithm>
#include <utility>

namespace cardan::program {

struct RunArguments {
    double duration = 60, step = 0.02, tolerance = 1e-6;
    int order = 2;
    std::string method = "dirk", out;
    bool resume = false;
};

inline void add_run_options(CommandLine& app, RunArguments& a) {
    app.add_option("--duration", a.duration, "simulated time, s");
    app.add_option("--method", a.method, "method of integration").one_of(method_names);
    app.add_option("--order", a.order, "highest order of bdf (beyond 2, weakly damped modes may grow)");
    app.add_option("--tolerance", a.tolerance, "relative tolerance of a step");
    app.add_option("--step", a.step, "time between outputs, s");
    app.add_option("--out", a.out, "prefix of the files");
}

/// Before any file is begun.  @throws InputError
inline void check_run_options(const RunArguments& a) {
    require_positive("--duration", "value", a.duration);
    require_positive("--step", "value", a.step);
}

/// What makes a run but its length, for its file: who goes on with it must want the same.
inline std::string options_text(const RunArguments& a) {
    return text("method ", a.method, ", order ", a.order, ", tolerance ", a.tolerance, ", step ", a.step, " s");
}

/// Of a description what makes a run: without the command, and without what its machine was read from and why it has no
/// air, where files are named that may be called from elsewhere.
inline std::string what_is_run(std::string description) {
    const auto erase = [&](std::size_t from, std::size_t to) {
        if (from < to && to != std::string::npos) description.erase(from, to - from);
    };
    if (description.starts_with("made by ")) erase(0, description.find("\n\n") + 2);
    erase(description.find(turbines::source_of_machine), description.rfind(turbines::computed_machine));
    const std::size_t reason = description.find("\nno_air: ");
    if (reason != std::string::npos) erase(reason, description.find('\n', reason + 1));
    return description;
}

/// The first parts in which two texts differ: entries of a line, separated by ", ".
struct Difference {
    std::string first, second;
};
inline Difference difference(const std::string& a, const std::string& b) {
    const auto part = [](const std::string& all, std::size_t& at) -> std::string {
        at = std::min(all.find_first_not_of(", \n", at), all.size());
        if (at == all.size()) return "nothing more";
        const std::size_t from = std::exchange(at, std::min({all.find('\n', at), all.find(", ", at), all.size()}));
        return all.substr(from, at - from);
    };
    for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
        const Difference found{part(a, i), part(b, k)};
        if (found.first != found.second) return found;
    }
    return {};
}

/// The checkpoint that a run goes on from; none: it begins.
/// @throws FileError, InputError if the file has no checkpoint or is of another run: what differs is named
inline std::optional<solvers::Checkpoint> start_of(const RunArguments& a, const std::string& description) {
    if (!a.resume) return std::nullopt;
    const std::string path = a.out + ".h5";
    const solvers::HistoryInfo info = solvers::read_history_info(path);
    if (!info.checkpoint) throw InputError("--resume", path, "without a checkpoint", "a run that was broken off");
    const std::string made = what_is_run(info.about.description), wanted = what_is_run(description);
    if (made == wanted) return info.checkpoint;
    const Difference differs = difference(made, wanted);
    throw InputError("--resume", text("run of ", path), differs.first, text("that of this run: ", differs.second));
}

inline solvers::IntegrationOptions integration_options(const RunArguments& a) {
    return integration_options(a.method, a.tolerance, a.order);
}

/// State at time zero.
struct Start {
    Vector q, qd;
};

/// Receives the rows of a recorder: keeps them, writes them to PREFIX.h5 as they come, and shows on a terminal how far
/// things are.
class Rows {
public:
    /// @param description  of the machine, for the file
    Rows(const std::string& title, const std::string& description, const RunArguments& a,
         solvers::Integrator& integrator, const solvers::Recorder& recorder)
        : history{title, recorder.channels(), {}, {}},
          file(a.out + ".h5", {.title = title, .method = a.method, .description = description}, integrator, recorder),
          duration_(a.duration) {
        history.values.resize(history.channels.size());
    }
    /// Goes on with the file of the same name.
    Rows(const RunArguments& a, solvers::Integrator& integrator, const solvers::Recorder& recorder)
        : history(solvers::read_history(a.out + ".h5")),
          file(a.out + ".h5", integrator, recorder),
          duration_(a.duration) {
        history.time.resize(file.rows());  // what came after the checkpoint comes again
        for (std::vector<double>& values : history.values) values.resize(file.rows());
    }
    void operator()(double time, const std::vector<double>& values) {
        if (!file.append(time, values)) return;
        history.time.push_back(time);
        for (std::size_t i = 0; i < values.size(); ++i) history.values[i].push_back(values[i]);
        const double now = watch_.elapsed().wall;
        if (now < told_ + 0.2) return;
        told_ = now;
        progress(text("\rtime ", std::round(time * 10) / 10, " of ", duration_, " s   "));
    }

    solvers::History history;
    RowFile file;

private:
    double duration_, told_ = 0;
    Stopwatch watch_;
};

/// Records at equal steps from `from`, as far as they are not past, to `to`.
inline solvers::Advance record(solvers::Integrator& integrator, solvers::Recorder& recorder, double from, double to,
                               double step, Rows& rows) {
    std::vector<double> times = solvers::sample_times(from, to, step);
    times.erase(times.begin(), std::ranges::lower_bound(times, integrator.time()));
    solvers::Advance result = solvers::record(
        integrator, recorder, times, [&](double time, const std::vector<double>& values) { rows(time, values); });
    require_result(result);
    return result;
}

/// Endings of everything a run leaves behind.
inline const std::initializer_list<const char*> run_outputs{".h5", ".svg", ".png", "_energy.png", "_spectrum.png"};

/// Closes the file, draws the pictures and says what there is.
/// @param complete  the run came to its end
/// @param panels    PREFIX.svg and .png
/// @param spectra   PREFIX_spectrum.png, of the stretch of time in `of`; none without panels
/// @param of        the rotor speed is that at the end
inline void write_outputs(Rows& rows, const std::string& prefix, bool complete,
                          const std::vector<solvers::HistoryPanel>& panels,
                          const std::vector<solvers::HistoryPanel>& spectra, SpectraOptions of) {
    rows.file.close(complete);
    const solvers::History& history = rows.history;
    std::cout << "\nfiles: " << prefix << ".h5 (" << history.time.size() << " samples of " << history.channels.size()
              << " channels)";
    if (history.time.size() > 1) {
        for (const char* ending : {".svg", ".png"}) solvers::plot(history, panels, prefix + ending);
        solvers::plot_energies(history, prefix + "_energy.png");
        std::cout << ", .svg, .png, _energy.png";
        of.rotor_speed = history["RotSpeed"].back();
        if (!spectra.empty() && plot_spectra(history, spectra, prefix + "_spectrum.png", of))
            std::cout << ", _spectrum.png";
    }
    std::cout << "\n";
}

}  // namespace cardan::program
