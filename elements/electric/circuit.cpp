#include "elements/electric/circuit.hpp"

#include "elements/electric/detail/circuit_equations.hpp"
#include "elements/electric/detail/circuit_loops.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace cardan {

namespace {

void require_finite(const std::string& where, const char* quantity, double value) {
    if (!std::isfinite(value)) throw InputError(where, quantity, value, "finite");
}

std::string where(const std::string& circuit, const char* kind, const std::string& name) {
    return text("circuit '", circuit, "': ", kind, " '", name, "'");
}

void resize(Inductance& inductance, Eigen::Index windings) {
    const auto grow = [windings](Matrix& m) {
        const Eigen::Index old = m.rows();
        m.conservativeResize(windings, windings);
        m.rightCols(windings - old).setZero();
        m.bottomRows(windings - old).setZero();
    };
    grow(inductance.constant);
    for (InductanceTerm& term : inductance.terms) grow(term.shape);
}

}  // namespace

Circuit::Circuit(Options options) : options_(std::move(options)) {
    if (options_.name.empty()) throw InputError("circuit: the name is missing");
    const std::string here = text("circuit '", options_.name, "'");
    require_positive(here, "scale of currents [A]", options_.current);
    require_positive(here, "scale of voltages [V]", options_.voltage);
    inductance_.constant.resize(0, 0);
}

void Circuit::add_branch(Kind kind, const std::string& name, const std::string& from, const std::string& to,
                         std::size_t at, double resistance) {
    const std::string here = where(options_.name, "branch", name);
    if (name.empty()) throw InputError(text("circuit '", options_.name, "': a branch without a name"));
    if (std::ranges::find(branches_, name, &Branch::name) != branches_.end())
        throw InputError(text(here, ": a branch of this name is there already"));
    if (from.empty() || to.empty()) throw InputError(text(here, ": a node without a name"));
    if (from == to) throw InputError(text(here, ": both ends are at node '", from, "'"));
    const auto node = [&](const std::string& own) {
        const auto found = std::ranges::find(nodes_, own);
        if (found != nodes_.end()) return static_cast<int>(found - nodes_.begin());
        nodes_.push_back(own);
        return static_cast<int>(nodes_.size()) - 1;
    };
    const int a = node(from), b = node(to);
    branches_.push_back({name, kind, a, b, at, resistance});
}

void Circuit::add_source(VoltageSource source) {
    add_branch(Kind::source, source.name, source.from, source.to, sources_.size(), 0);
    sources_.push_back(std::move(source));
}

void Circuit::add_resistor(const Resistor& resistor) {
    require_positive(where(options_.name, "resistor", resistor.name), "resistance [ohm]", resistor.resistance);
    add_branch(Kind::resistor, resistor.name, resistor.from, resistor.to, 0, resistor.resistance);
}

void Circuit::add_capacitor(const Capacitor& capacitor) {
    const std::string here = where(options_.name, "capacitor", capacitor.name);
    require_positive(here, "capacitance [F]", capacitor.capacitance);
    require_finite(here, "voltage at the start [V]", capacitor.initial_voltage);
    add_branch(Kind::capacitor, capacitor.name, capacitor.from, capacitor.to, capacitors_.size(), 0);
    capacitors_.push_back(capacitor);
}

void Circuit::add_winding(const Winding& winding) {
    const std::string here = where(options_.name, "winding", winding.name);
    require_not_negative(here, "resistance [ohm]", winding.resistance);
    require_not_negative(here, "inductance [H]", winding.inductance);
    add_branch(Kind::winding, winding.name, winding.from, winding.to, windings_.size(), winding.resistance);
    windings_.push_back(branches_.size() - 1);
    const Eigen::Index n = std::ssize(windings_);
    resize(inductance_, n);
    inductance_.constant(n - 1, n - 1) = winding.inductance;
}

Eigen::Index Circuit::winding(std::string_view name) const {
    const auto found = std::ranges::find_if(windings_, [&](std::size_t at) { return branches_[at].name == name; });
    if (found == windings_.end())
        throw InputError(text("circuit '", options_.name, "': there is no winding '", name, "'"));
    return found - windings_.begin();
}

void Circuit::couple(std::string_view a, std::string_view b, double inductance) {
    const Eigen::Index i = winding(a), j = winding(b);
    require_finite(where(options_.name, "winding", std::string(a)), "mutual inductance [H]", inductance);
    if (i == j) throw InputError(text(where(options_.name, "winding", std::string(a)), " is coupled with itself"));
    inductance_.constant(i, j) = inductance_.constant(j, i) = inductance;
}

void Circuit::vary(std::string_view a, std::string_view b, BodyId coordinate, CurveOf curve) {
    const Eigen::Index i = winding(a), j = winding(b), n = std::ssize(windings_);
    if (!curve) throw InputError(text(where(options_.name, "winding", std::string(a)), ": the curve is missing"));
    Matrix shape = Matrix::Zero(n, n);
    shape(i, j) = shape(j, i) = 1;
    inductance_.terms.push_back({std::move(shape), coordinate, std::move(curve)});
}

void Circuit::add_inductance(const Inductance& inductance) {
    const Eigen::Index n = std::ssize(windings_);
    const auto check = [&](const Matrix& m) {
        if (m.rows() != n || m.cols() != n)
            throw InputError(text("circuit '", options_.name, "'"), "rows of an inductance matrix", m.rows(),
                             text(n, ", one for each winding"));
        if (!m.allFinite() || (m - m.transpose()).cwiseAbs().maxCoeff() > 1e-12 * m.cwiseAbs().maxCoeff())
            throw InputError(text("circuit '", options_.name, "': an inductance matrix is not finite and symmetric"));
    };
    check(inductance.constant);
    for (const InductanceTerm& term : inductance.terms) {
        check(term.shape);
        if (!term.factor)
            throw InputError(text("circuit '", options_.name, "': the curve of an inductance is missing"));
    }
    inductance_.constant += inductance.constant;
    inductance_.terms.insert(inductance_.terms.end(), inductance.terms.begin(), inductance.terms.end());
}

void Circuit::add_magnet(std::string_view winding_name, BodyId coordinate, CurveOf curve) {
    if (!curve)
        throw InputError(text(where(options_.name, "winding", std::string(winding_name)), ": the curve is missing"));
    magnets_.push_back({winding(winding_name), coordinate, std::move(curve)});
}

std::vector<BodyId> Circuit::coordinates() const {
    std::vector<BodyId> all;
    const auto add = [&](BodyId coordinate) {
        if (std::ranges::find(all, coordinate) == all.end()) all.push_back(coordinate);
    };
    for (const InductanceTerm& term : inductance_.terms) add(term.coordinate);
    for (const Magnet& magnet : magnets_) add(magnet.coordinate);
    return all;
}

detail::CircuitLoops Circuit::loops() const {
    std::vector<detail::CircuitEdge> edges;
    edges.reserve(branches_.size());
    for (const Branch& branch : branches_)
        edges.push_back({branch.name, branch.from, branch.to, static_cast<int>(branch.kind)});
    detail::CircuitLoops loops = detail::circuit_loops(edges, static_cast<int>(nodes_.size()));
    for (std::size_t k = 0; k < loops.links.size(); ++k) {
        const Kind kind = branches_[loops.links[k]].kind;
        if (kind == Kind::source || kind == Kind::capacitor)
            throw InputError(text("circuit '", options_.name, "': the loop of ", loops.path(k, edges),
                                  " has nothing but sources and capacitors; it needs a resistor or a winding"));
    }
    return loops;
}

std::vector<std::string> Circuit::states() const {
    std::vector<std::string> names;
    names.reserve(branches_.size());
    for (const std::size_t link : loops().links)
        if (branches_[link].kind == Kind::winding) names.push_back(branches_[link].name + " flux");
    for (const Capacitor& capacitor : capacitors_) names.push_back(capacitor.name + " voltage");
    return names;
}

detail::CircuitEquations Circuit::equations(ForceElement& element) const {
    const detail::CircuitLoops found = loops();
    const auto branches = std::ssize(branches_), capacitor_count = std::ssize(capacitors_),
               source_count = std::ssize(sources_);
    std::vector<Eigen::Index> windings, resistors;  // columns of B
    for (Eigen::Index k = 0; k < std::ssize(found.links); ++k)
        (branches_[entry(found.links, k)].kind == Kind::winding ? windings : resistors).push_back(k);
    detail::CircuitEquations out;
    out.name = options_.name;
    for (const auto count : {std::ssize(windings), capacitor_count, source_count, std::ssize(coordinates())})
        if (count > detail::CircuitEquations::max_size)
            throw InputError(text("circuit '", options_.name, "'"),
                             "number of loops, capacitors, sources or coordinates", count,
                             text("at most ", detail::CircuitEquations::max_size));
    out.resistance.resize(branches);
    for (Eigen::Index row = 0; row < branches; ++row) out.resistance(row) = entry(branches_, row).resistance;

    // Resistors that are links: B_r^T (R i - w) = 0 with w = v - u.
    const Matrix B = found.B(Eigen::all, windings), B_r = found.B(Eigen::all, resistors);
    const Matrix RB = out.resistance.asDiagonal() * B, RB_r = out.resistance.asDiagonal() * B_r;
    const Matrix solved = B_r * Matrix(B_r.transpose() * RB_r).llt().solve(Matrix(B_r.transpose()));
    out.A_j = B - solved * RB;
    Matrix of_sources = Matrix::Zero(branches, source_count), of_capacitors = Matrix::Zero(branches, capacitor_count);
    out.capacitance.resize(capacitor_count);
    for (Eigen::Index row = 0; row < branches; ++row) {
        const Branch& branch = entry(branches_, row);
        const auto at = static_cast<Eigen::Index>(branch.at);
        if (branch.kind == Kind::source) {
            of_sources(row, at) = 1;
            out.source_branches.push_back(row);
        } else if (branch.kind == Kind::capacitor) {
            of_capacitors(row, at) = 1;
            out.capacitors.push_back(row);
            out.capacitance(at) = entry(capacitors_, at).capacitance;
        }
    }
    out.A_s = solved * of_sources;
    out.A_c = solved * of_capacitors;
    out.F_j = -B.transpose() * out.resistance.asDiagonal() * out.A_j;
    const Matrix drop = B.transpose() - B.transpose() * out.resistance.asDiagonal() * solved;
    out.F_s = drop * of_sources;
    out.F_c = drop * of_capacitors;

    const std::vector<BodyId> seen = coordinates();
    const auto place = [&](BodyId coordinate) { return std::ranges::find(seen, coordinate) - seen.begin(); };
    const Matrix of_windings = B(windings_, Eigen::all);
    out.coordinates = std::ssize(seen);
    out.constant = of_windings.transpose() * inductance_.constant * of_windings;
    for (const InductanceTerm& term : inductance_.terms)
        out.terms.push_back({of_windings.transpose() * term.shape * of_windings, place(term.coordinate), term.factor});
    for (const Magnet& magnet : magnets_)
        out.magnets.push_back({of_windings.row(magnet.winding).transpose(), place(magnet.coordinate), magnet.flux});
    for (const VoltageSource& source : sources_)
        out.sources.push_back({source.over_time, ControlWire(source.signal, element)});
    return out;
}

Circuit::Built Circuit::build() const {
    Built built{.element = {.name = options_.name, .coordinates = coordinates()}, .equations = {}};
    ForceElement& element = built.element;
    built.equations = std::make_shared<const detail::CircuitEquations>(equations(element));
    built.equations->check(detail::CircuitEquations::Column::Zero(built.equations->coordinates));
    const Vector inductances = built.equations->inductance_at_zero();
    const std::vector<std::string> names = states();
    for (Eigen::Index k = 0; k < std::ssize(names); ++k) {
        const bool flux = k < inductances.size();
        element.states.push_back({.name = entry(names, k),
                                  .unit = flux ? "V s" : "V",
                                  .scale = flux ? options_.current * inductances(k) : options_.voltage,
                                  .initial = flux ? 0 : entry(capacitors_, k - inductances.size()).initial_voltage,
                                  .part = options_.part,
                                  .blade = options_.blade});
    }
    return built;
}

ForceElement Circuit::element() const {
    Built built = build();
    ForceElement& element = built.element;
    const auto& equations = built.equations;
    element.evaluate = [own = equations](const ElementView& in, ElementForces& out) { own->rates(in, out.Q, out.f); };
    element.jacobian = [own = equations](const ElementView& in, ElementJacobian& d) { own->jacobian(in, d); };
    element.power = [own = equations](const ElementView& in) { return own->power(in); };
    for (const VoltageSource& source : sources_)
        element.breaks.insert(element.breaks.end(), source.breaks.begin(), source.breaks.end());
    return std::move(element);
}

ChannelGroup Circuit::channels() const {
    ChannelGroup group;
    for (const Branch& branch : branches_)
        group.channels.push_back(
            {.name = branch.name + " current",
             .units = "A",
             .long_name = text("current of '", branch.name, "' in circuit '", options_.name, "', positive from '",
                               entry(nodes_, branch.from), "' to '", entry(nodes_, branch.to), "'")});
    for (std::size_t k = 1; k <= coordinates().size(); ++k)
        group.channels.push_back({.name = text(options_.name, " force on ", k),
                                  .units = "1",
                                  .long_name = text("generalised force of circuit '", options_.name,
                                                    "' on its coordinate ", k, ", N m or N")});
    group.sample = [own = build()](const DynamicView& in, double* values) {
        const ElementValues at(in.forces.elements(), own.element.name, in);
        const Vector currents = own.equations->branch_currents(at.view());
        const detail::CircuitEquations::Column forces = own.equations->forces(at.view());
        values = std::copy(currents.begin(), currents.end(), values);
        std::copy(forces.begin(), forces.end(), values);
    };
    return group;
}

}  // namespace cardan
