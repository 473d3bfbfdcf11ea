#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell_data/diagram.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

namespace cardan::solvers {

namespace {

// "    0.9581 ( -4.53) ?", "-" without a mode.
std::string cell(const Campbell& diagram, const Branch& branch, std::size_t point) {
    std::ostringstream out = text_stream();
    if (branch.mode[point] < 0) {
        out << std::setw(21) << "-";
        return out.str();
    }
    const double damping = diagram.damping_ratio(branch, point);
    out << std::fixed << std::setw(10) << std::setprecision(4) << diagram.natural_hz(branch, point) << " ("
        << std::setw(6) << std::setprecision(2);
    if (std::isfinite(damping))
        out << (std::abs(damping) < 5e-5 ? 0 : 100 * damping);  // not -0.00
    else
        out << "-";
    out << ")" << (branch.doubtful[point] ? " ?" : "  ");
    return out.str();
}

bool has_blade_frequencies(const Campbell& diagram) {
    const auto turns = [](const CampbellPoint& point) { return point.rotor_speed != 0; };
    return std::ranges::any_of(diagram.points, turns) &&
           std::ranges::any_of(diagram.branches, [](const Branch& b) { return b.pattern == RotorPattern::single; });
}

std::string margins(const Campbell& diagram, const std::vector<std::size_t>& shown, int width) {
    if (!std::isfinite(diagram.points[0].stability_margin)) return {};
    std::ostringstream out = text_stream();
    out << "\n" << std::left << std::setw(width) << "stability margin, 1/s" << std::right << std::setprecision(4);
    for (std::size_t i : shown) {
        out << std::setw(19) << diagram.points[i].stability_margin << "  ";
    }
    out << "\n";
    return out.str();
}

// Of more states than fit on a screen, the motions that decay most slowly and fastest.
std::string many_state_motions(const Campbell& diagram, const std::vector<std::size_t>& shown, int width) {
    std::ostringstream out = text_stream();
    out << "\nknown motions of states rather than of the machine (all of these are in the file)\n"
        << std::setprecision(4);
    const auto row = [&](const char* what, const auto& value) {
        out << std::left << std::setw(width) << what << std::right;
        for (const std::size_t i : shown) {
            out << std::setw(19);
            if (diagram.points[i].state_motions.empty())
                out << "-";
            else
                out << value(diagram.points[i].state_motions);
            out << "  ";
        }
        out << "\n";
    };
    const auto real = [](const StateMotion& motion) { return motion.mode.eigenvalue.real(); };
    row("their number", [](const auto& all) { return all.size(); });
    row("slowest decay, 1/s", [&](const auto& all) { return -real(*std::ranges::max_element(all, {}, real)); });
    row("fastest decay, 1/s", [&](const auto& all) { return -real(*std::ranges::min_element(all, {}, real)); });
    return out.str();
}

// A line for each state and each of its motions: "real part, 1/s; frequency, Hz".
std::string state_motions(const Campbell& diagram, const std::vector<std::size_t>& shown, int width) {
    constexpr std::size_t most = 24;
    if (std::ranges::all_of(diagram.points, [](const CampbellPoint& point) { return point.state_motions.empty(); }))
        return {};
    if (diagram.states.size() > most) return many_state_motions(diagram, shown, width);
    std::vector<std::vector<std::vector<Complex>>> found(diagram.states.size());  // [state][shown]
    for (auto& of_state : found) of_state.resize(shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i)
        for (const StateMotion& motion : diagram.points[shown[i]].state_motions)
            entry(found, motion.state)[i].push_back(motion.mode.eigenvalue);
    std::ostringstream out = text_stream();
    for (std::size_t k = 0; k < found.size(); ++k) {
        std::size_t lines = 0;
        for (const auto& at : found[k]) lines = std::max(lines, at.size());
        for (std::size_t line = 0; line < lines; ++line) {
            out << std::left << std::setw(width) << diagram.states[k] << std::right << std::setprecision(4);
            for (const auto& at : found[k])
                if (line < at.size())
                    out << std::setw(10) << at[line].real() << std::setw(9) << at[line].imag() / (2 * pi) << "  ";
                else
                    out << std::setw(19) << "-"
                        << "  ";
            out << "\n";
        }
    }
    if (out.str().empty()) return {};
    return text("\nmotions of states rather than of the machine: real part, 1/s, and frequency, Hz\n", out.str());
}

// Those in the upper half of the range, where machines run; high multiples cross everything at low speeds.
std::string crossings(const Campbell& diagram) {
    if (diagram.crossings.empty()) return "";
    const double half =
        std::max(std::abs(diagram.points.front().rotor_speed), std::abs(diagram.points.back().rotor_speed)) / 2;
    std::ostringstream out = text_stream();
    out << std::fixed << "\ncrossings with multiples of the rotor speed\n";
    long lower = 0;
    for (const Crossing& crossing : diagram.crossings) {
        if (std::abs(crossing.rotor_speed) < half) {
            ++lower;
            continue;
        }
        out << "  " << std::setw(2) << crossing.multiple << "P at " << std::setw(6) << std::setprecision(2)
            << crossing.rotor_speed * units::to_rpm << " rpm, " << std::setw(7) << std::setprecision(4)
            << crossing.frequency_hz << " Hz: " << entry(diagram.branches, crossing.branch).name << "\n";
    }
    if (lower > 0)
        out << "  " << lower << " more below " << std::setprecision(2) << half * units::to_rpm
            << " rpm: in files of the diagram\n";
    return out.str();
}

// Why the names and frequencies are in doubt that are marked.
std::string doubts(const Campbell& diagram, const std::vector<std::size_t>& shown, bool states) {
    std::ostringstream out = text_stream();
    out << std::fixed << std::setprecision(1);
    for (const Branch& branch : diagram.branches) {
        if (branch.of_states && !states) continue;
        for (const std::size_t i : shown) {
            if (branch.mode[i] < 0 || !branch.doubtful[i]) continue;
            out << "  " << branch.name << " at ";
            if (diagram.parameters.empty())
                out << diagram.points[i].rotor_speed * units::to_rpm << " rpm";
            else
                out << text(diagram.parameters[i]);
            out << ": " << branch.doubt[i] << "\n";
        }
    }
    return out.str().empty() ? std::string() : "\n? in doubt there\n" + out.str();
}

}  // namespace

std::string method_in_words(const Campbell& diagram) {
    return text(diagram.method, diagram.method_reason.empty() ? "" : "; chosen: ", diagram.method_reason);
}

std::string table(const Campbell& diagram, bool states) {
    std::ostringstream out = text_stream();
    if (diagram.points.empty()) return "no rotor speeds computed\n";
    std::vector<std::size_t> shown{0};
    for (std::size_t i : {diagram.points.size() / 2, diagram.points.size() - 1})
        if (i != shown.back()) shown.push_back(i);
    std::size_t longest = 32;
    for (const Branch& branch : diagram.branches) longest = std::max(longest, branch.name.size());
    const int width = static_cast<int>(longest) + 2;
    out << diagram.machine << ": natural frequency |lambda| / 2 pi, Hz (damping ratio, %); " << method_in_words(diagram)
        << "\n"
        << (diagram.remark.empty() ? "" : diagram.remark + "\n") << "\n"
        << (diagram.parameter.empty() ? std::string() : text("over ", diagram.parameter, "\n\n")) << std::left
        << std::setw(width) << "mode" << std::right << std::fixed;
    for (std::size_t i : shown) {
        if (diagram.parameters.empty())
            out << std::setw(15) << std::setprecision(1) << diagram.points[i].rotor_speed * units::to_rpm << " rpm  ";
        else
            out << std::setw(19) << text(diagram.parameters[i]) << "  ";
    }
    out << "\n";
    for (const Branch& branch : diagram.branches) {
        if (branch.of_states && !states) continue;
        out << std::left << std::setw(width) << branch.name << std::right;
        for (std::size_t i : shown) out << cell(diagram, branch, i);
        out << "\n";
    }
    out << state_motions(diagram, shown, width);
    out << margins(diagram, shown, width);
    if (!diagram.accuracy.empty()) out << diagram.accuracy << "\n";
    out << doubts(diagram, shown, states);
    const auto left_out = std::ranges::count_if(diagram.branches, &Branch::of_states);
    if (left_out > 0 && !states) out << left_out << " roots that are mostly states are left out\n";
    if (has_blade_frequencies(diagram)) out << "modes of one blade: frequencies in its rotating frame\n";
    out << crossings(diagram);
    if (!diagram.warning.empty()) out << "\nwarning: " << diagram.warning << "\n";
    if (!diagram.complete) out << "\nthe sweep was interrupted: only the rotor speeds above were computed\n";
    return out.str();
}

}  // namespace cardan::solvers
