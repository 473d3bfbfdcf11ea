#include "solvers/linear_models/lin_file.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/version.hpp"

#include <algorithm>
#include <string>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

std::string right(const std::string& words, std::size_t width) {
    return std::string(width - std::min(width, words.size()), ' ') + words;
}

// As Fortran's ES25.16E2 and printf's %25.16E.
std::string number(double value) {
    std::string all = digits(value, std::chars_format::scientific, 16);
    for (char& c : all) c = upper_case(c);
    return right(all, 25);
}

// "rad s-1" -> "rad/s", as the readers know it; others with a point between factors: "N-m".
std::string units_of(const Signal& signal) {
    const std::string& units = signal.units;
    if (units == "N m") return "N-m";
    if (units.ends_with(" s-1")) return units.substr(0, units.size() - 4) + "/s";
    if (units.ends_with(" s-2")) return units.substr(0, units.size() - 4) + "/s^2";
    return units == "1" ? "-" : units;
}

std::string padded(std::string words, std::size_t width) {
    if (words.size() < width) words.append(width - words.size(), ' ');
    return words;
}

// Row of a state, its derivative, an input or an output.
struct Row {
    double value;
    bool rotating;
    int order;
    std::string description;
};

void add_table(std::string& out, const std::string& title, const char* first, const std::vector<Row>& rows) {
    if (rows.empty()) return;
    out += "Order of " + title + ":\n";
    const auto heading = [&](const std::string& a, const char* b, const char* c, const char* d, const char* e) {
        out += "   " + padded(a, 10) + " " + padded(b, 27) + c + " " + d + " " + e + "\n";
    };
    heading(first, "Operating Point", "Rotating Frame?", "Derivative Order", "Description");
    heading("----------", "---------------", "---------------", "----------------", "-----------");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out += "   " + right(text(i + 1), 8) + "   " + number(rows[i].value) + " " +
               right(rows[i].rotating ? "T" : "F", 8) + "        " + right(text(rows[i].order), 8) + "         " +
               rows[i].description + "\n";
    }
    out += "\n";
}

void add_matrix(std::string& out, const char* name, const Matrix& A) {
    if (A.size() == 0) return;
    out += text(name, ": ", A.rows(), " x ", A.cols(), "\n");
    for (Index i = 0; i < A.rows(); ++i) {
        for (Index j = 0; j < A.cols(); ++j) out += number(A(i, j));
        out += "\n";
    }
}

// Whether all blades have this signal: names in triplets (or more) that differ in the number only.
bool in_all_blades(const std::vector<Signal>& signals, const Signal& signal, int blades) {
    if (signal.blade == 0 || blades < 2) return false;
    const std::string own = text("blade ", signal.blade);
    if (!signal.name.starts_with(own)) return false;
    const std::string rest = signal.name.substr(own.size());
    for (int k = 1; k <= blades; ++k) {
        bool found = false;
        for (const Signal& other : signals) found = found || other.name == text("blade ", k, rest);
        if (!found) return false;
    }
    return true;
}

std::string name_of(const Signal& signal) {
    return signal.alias.empty() ? signal.name : signal.alias;
}

class Writer {
public:
    explicit Writer(const LinearModel& model) : m_(model) {}

    std::string written(const LinearSample& sample) const {
        std::string out;
        head(out, sample);
        add_table(out, "continuous states", "Row/Column", states(sample.x, false));
        add_table(out, "continuous state derivatives", "Row/Column", states(sample.xdot, true));
        add_table(out, "inputs", "Column  ", signals(m_.inputs, sample.u));
        add_table(out, "outputs", "Row  ", signals(m_.outputs, sample.y));
        out += "\nLinearized state matrices:\n\n";
        add_matrix(out, "A", sample.A);
        add_matrix(out, "B", sample.B);
        add_matrix(out, "C", sample.C);
        add_matrix(out, "D", sample.D);
        return out;
    }

private:
    void head(std::string& out, const LinearSample& sample) const {
        std::string description = m_.description.substr(0, m_.description.find('\n'));
        if (description == m_.machine) description.clear();
        out += text("\nLinearized model: Cardan ", version(), "\n units: SI (rad, rad/s, m, N, N-m)\n\n");
        out += text(m_.machine, description.empty() ? "" : "; ", description, "\n\nSimulation information:\n");
        const auto quantity = [&](const char* name, double value, const char* units) {
            out += "   " + padded(name, 32) + " " + number(value) + " " + units + "\n";
        };
        const auto count = [&](const char* name, std::size_t value) {
            out += "   " + padded(name, 32) + text(" ", value, "\n");
        };
        quantity("Simulation time:", sample.time, "s");
        quantity("Rotor Speed:", m_.rotor_speed, "rad/s");
        quantity("Azimuth:", sample.azimuth, "rad");
        count("Number of continuous states:", m_.states.size());
        count("Number of discrete states:", 0);
        count("Number of constraint states:", 0);
        count("Number of inputs:", m_.inputs.size());
        count("Number of outputs:", m_.outputs.size());
        out += "   Jacobians included in this file?    No\n\n";
    }
    std::vector<Row> states(const Vector& values, bool derivative) const {
        std::vector<Row> rows;
        const Index half = (std::ssize(m_.states) - m_.first_order) / 2;
        for (Index i = 0; i < std::ssize(m_.states); ++i) {
            const bool first_order = i >= 2 * half;
            const Signal& position = entry(m_.states, first_order ? i : i % half);
            std::string name = text(position.name, ", ", units_of(position));
            if (i >= half && !first_order) name = text("First time derivative of ", name, "/s");
            // Blade coordinates come in sets always; their numbers stand somewhere in the name.
            rows.push_back({values(i), position.blade > 0, first_order ? 1 : 2,
                            derivative ? text("First time derivative of Cardan ", name, "/s") : text("Cardan ", name)});
        }
        return rows;
    }
    std::vector<Row> signals(const std::vector<Signal>& list, const Vector& values) const {
        std::vector<Row> rows;
        for (Index i = 0; i < std::ssize(list); ++i) {
            const Signal& signal = entry(list, i);
            rows.push_back({values(i), in_all_blades(list, signal, m_.blades), 0,
                            text("Cardan ", name_of(signal), ", ", units_of(signal))});
        }
        return rows;
    }

    const LinearModel& m_;
};

}  // namespace

std::vector<std::filesystem::path> write_lin(const LinearModel& model, const std::filesystem::path& prefix) {
    if (model.samples.empty()) throw InputError("linearisation files", "number of azimuths", 0, ">= 1");
    std::vector<std::filesystem::path> paths;
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        paths.emplace_back(text(prefix.string(), ".", i + 1, ".lin"));
        write_file(paths.back(), Writer(model).written(model.samples[i]));
    }
    // Tools take all existing files for one model.
    for (std::size_t i = model.samples.size() + 1;; ++i)
        if (std::error_code error; !std::filesystem::remove(text(prefix.string(), ".", i, ".lin"), error)) return paths;
}

}  // namespace cardan::solvers
