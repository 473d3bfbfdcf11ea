/// @file
/// A run in time on its way to a file: options, rows with checkpoints, how to go on, pictures.
#pragma once

#include "mbs/base/error.hpp"
#include "programs/shared/simulation.hpp"
#include "turbines/analysis/resume.hpp"

#include <algorithm>
#include <utility>

namespace cardan::program {

struct RunArguments {
    double duration = 60, step = 0.02, tolerance = 1e-6;
    int order = 2;
    std::string method = "dirk", out;
    bool resume = false;
};

inline void add_integration_options(CommandLine& app, RunArguments& a) {
    app.add_option("--method", a.method, "method of integration").one_of(method_names);
    app.add_option("--order", a.order, "highest order of bdf (beyond 2, weakly damped modes may grow)");
    app.add_option("--tolerance", a.tolerance, "relative tolerance of a step");
    app.add_option("--step", a.step, "time between outputs, s");
    app.add_option("--out", a.out, "prefix of the files");
}

inline void add_run_options(CommandLine& app, RunArguments& a) {
    app.add_option("--duration", a.duration, "simulated time, s");
    add_integration_options(app, a);
}

/// Checks the options of a run before any file is begun.  @throws InputError
inline void check_run_options(const RunArguments& a) {
    require_positive("--duration", "value", a.duration);
    require_positive("--step", "value", a.step);
    constexpr double max = 1e8;
    if (a.duration / a.step > max)
        throw InputError("--duration", "steps of the output", a.duration / a.step, text("at most ", max));
    require_positive("--tolerance", "relative tolerance", a.tolerance);
    if (a.order < 0 || a.order > 5) throw InputError("--order", "highest order", a.order, "0 ... 5");
}

/// Options of a run but its length, for its file: who goes on with it must want the same.
inline std::string options_text(const RunArguments& a) {
    return text("method ", a.method, ", order ", a.order, ", tolerance ", a.tolerance, ", step ", a.step, " s");
}

/// The checkpoint that a run goes on from; none: it begins.
/// @throws FileError, InputError if the file has no checkpoint or is of another run: what differs is named
inline std::optional<solvers::Checkpoint> start_of(const RunArguments& a, const std::string& description) {
    if (!a.resume) return std::nullopt;
    return turbines::resumed_checkpoint(a.out + ".h5", description);
}

inline solvers::IntegrationOptions integration_options(const RunArguments& a) {
    return integration_options(a.method, a.tolerance, a.order);
}

/// Shows on a terminal how far a run is: not at every call, but a few times a second.
class TimeShown {
public:
    explicit TimeShown(double duration) : duration_(duration) {}
    void operator()(double time) {
        const double now = watch_.elapsed().wall;
        if (now < told_ + 0.2) return;
        told_ = now;
        progress(text("\rtime ", std::round(time * 10) / 10, " of ", duration_, " s   "));
    }

private:
    double duration_, told_ = 0;
    Stopwatch watch_;
};

/// Receives the rows of a recorder, and shows on a terminal how far things are.
class Rows {
public:
    /// Rows on their way to a new file, PREFIX.h5.
    /// @param description  of the machine, for the file
    Rows(const std::string& title, const std::string& description, const RunArguments& a,
         solvers::Integrator& integrator, const solvers::Recorder& recorder)
        : file(a.out + ".h5", {.title = title, .method = a.method, .description = description}, integrator, recorder),
          shown_(a.duration) {}
    /// Goes on with the file of that name.
    Rows(const RunArguments& a, solvers::Integrator& integrator, const solvers::Recorder& recorder)
        : file(a.out + ".h5", integrator, recorder), shown_(a.duration) {}
    void operator()(double time, const std::vector<double>& values) {
        if (file.append(time, values)) shown_(time);
    }
    const solvers::History& history() const { return file.history(); }

    solvers::HistoryRecording file;

private:
    TimeShown shown_;
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

/// Draws the pictures of PREFIX.h5, which is closed, and says what there is.
/// @param channels  of the file; those of the pictures, of the energies and RotSpeed are in the history
/// @param panels    PREFIX.svg and .png
/// @param spectra   PREFIX_spectrum.png, of the stretch of time in `of`; none without panels
/// @param of        the rotor speed is that at the end
inline void write_pictures(const solvers::History& history, std::size_t channels, const std::string& prefix,
                           const std::vector<solvers::HistoryPanel>& panels,
                           const std::vector<solvers::HistoryPanel>& spectra, SpectraOptions of) {
    std::cout << "\nfiles: " << prefix << ".h5 (" << history.time.size() << " samples of " << channels << " channels)";
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

/// Closes the file before.
/// @param complete  the run came to its end
inline void write_outputs(Rows& rows, const std::string& prefix, bool complete,
                          const std::vector<solvers::HistoryPanel>& panels,
                          const std::vector<solvers::HistoryPanel>& spectra, const SpectraOptions& of) {
    rows.file.close(complete);
    write_pictures(rows.history(), rows.history().channels.size(), prefix, panels, spectra, of);
}

}  // namespace cardan::program
