#include "elements/controllers/control_signal.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

std::vector<ControlSource> joined(const std::vector<ControlSource>& a, const std::vector<ControlSource>& b) {
    std::vector<ControlSource> all = a;
    all.insert(all.end(), b.begin(), b.end());
    return all;
}

ControlSignal of(ControlSource source) {
    return {{std::move(source)}, [](const double* x, double* gradient) {
                gradient[0] = 1;
                return x[0];
            }};
}

// Sum with a sign.
ControlSignal sum(const ControlSignal& a, double sign, const ControlSignal& b) {
    const std::size_t first = a.sources().size(), second = b.sources().size();
    return {joined(a.sources(), b.sources()), [a, b, sign, first, second](const double* x, double* gradient) {
                const double left = a.value(x, gradient), right = b.value(x + first, gradient + first);
                for (std::size_t i = 0; i < second; ++i) gradient[first + i] *= sign;
                return left + sign * right;
            }};
}

}  // namespace

ControlSignal::ControlSignal(std::vector<ControlSource> sources, Function function)
    : sources_(std::move(sources)), function_(std::move(function)) {
    if (sources_.size() > max_sources)
        throw InputError("signal", "number of sources", sources_.size(), text("at most ", max_sources));
    if (!function_) throw InputError("signal: the function is missing");
}

ControlSignal ControlSignal::through(std::function<Point(double)> f) const {
    if (!f) throw InputError("signal: the function is missing");
    const std::size_t count = sources_.size();
    return {sources_, [inner = *this, f = std::move(f), count](const double* x, double* gradient) {
                const Point at = f(inner.value(x, gradient));
                for (std::size_t i = 0; i < count; ++i) gradient[i] *= at.slope;
                return at.value;
            }};
}

ControlSignal ControlSignal::through(const MonotoneCubic& table) const {
    return through([table](double x) {
        const MonotoneCubic::Value at = table.at(x);
        return Point{at.value, at.slope};
    });
}

ControlSignal operator+(const ControlSignal& a, const ControlSignal& b) {
    return sum(a, 1, b);
}

ControlSignal operator-(const ControlSignal& a, const ControlSignal& b) {
    return sum(a, -1, b);
}

ControlSignal operator*(const ControlSignal& a, const ControlSignal& b) {
    const std::size_t first = a.sources().size(), second = b.sources().size();
    return {joined(a.sources(), b.sources()), [a, b, first, second](const double* x, double* gradient) {
                const double left = a.value(x, gradient), right = b.value(x + first, gradient + first);
                for (std::size_t i = 0; i < first; ++i) gradient[i] *= right;
                for (std::size_t i = 0; i < second; ++i) gradient[first + i] *= left;
                return left * right;
            }};
}

ControlSignal operator*(double factor, const ControlSignal& a) {
    return a.through([factor](double x) { return ControlSignal::Point{factor * x, factor}; });
}

namespace signal {

ControlSignal position(BodyId coordinate) {
    return of({ControlSource::Kind::position, coordinate});
}
ControlSignal rate(BodyId coordinate) {
    return of({ControlSource::Kind::rate, coordinate});
}
ControlSignal state(std::string name) {
    return of({ControlSource::Kind::state, {}, std::move(name)});
}
ControlSignal input(std::string name) {
    return of({ControlSource::Kind::input, {}, std::move(name)});
}
ControlSignal constant(double value) {
    return {{}, [value](const double*, double*) { return value; }};
}

}  // namespace signal

// A parabola of the width of two roundings joins the line and the limit.
ControlSignal::Point SoftLimits::operator()(double x) const {
    const double width = rounding * std::min(upper - lower, 1e290);
    if (!(upper - lower < 1e290)) return {std::clamp(x, lower, upper), x > lower && x < upper ? 1.0 : 0.0};
    const double above = x - (upper - width), below = (lower + width) - x;
    if (above <= 0 && below <= 0) return {x, 1};
    const double beyond = std::max(above, below), sign = above > 0 ? 1 : -1, limit = above > 0 ? upper : lower;
    if (beyond >= 2 * width) return {limit, 0};
    const double left = 2 * width - beyond;
    return {limit - sign * left * left / (4 * width), left / (2 * width)};
}

void SoftLimits::check(const std::string& where, const std::string& quantity) const {
    if (!(lower < upper))
        throw InputError(where, text("limits of the ", quantity), text(lower, " ... ", upper), "rising");
    if (!(rounding > 0 && rounding < 0.5))
        throw InputError(where, text("rounding of the limits of the ", quantity), rounding, "0 ... 0.5, exclusive");
}

ControlWire::ControlWire(const ControlSignal& signal, ForceElement& element) : signal_(signal) {
    const auto place = [](auto& list, const auto& value) {
        const auto at = std::ranges::find(list, value);
        if (at != list.end()) return at - list.begin();
        list.push_back(value);
        return std::ssize(list) - 1;
    };
    using Kind = ControlSource::Kind;
    for (const ControlSource& source : signal.sources()) {
        const auto own = std::ranges::find(element.states, source.name, &StateInfo::name);
        if (source.kind == Kind::position)
            ends_.push_back({Block::q, place(element.coordinates, source.coordinate)});
        else if (source.kind == Kind::rate)
            ends_.push_back({Block::qd, place(element.coordinates, source.coordinate)});
        else if (source.kind == Kind::input)
            ends_.push_back({Block::u, place(element.inputs, source.name)});
        else if (own != element.states.end())
            ends_.push_back({Block::s, own - element.states.begin()});
        else
            ends_.push_back({Block::others, place(element.reads, source.name)});
    }
}

double ControlWire::value(const ElementView& in, std::array<double, ControlSignal::max_sources>& gradient) const {
    std::array<double, ControlSignal::max_sources> x{};
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        const Eigen::Index at = ends_[i].at;
        switch (ends_[i].block) {
            case Block::q:
                x.at(i) = in.q(at);
                break;
            case Block::qd:
                x.at(i) = in.qd(at);
                break;
            case Block::s:
                x.at(i) = in.s(at);
                break;
            case Block::others:
                x.at(i) = in.others(at);
                break;
            case Block::u:
                x.at(i) = in.u(at);
                break;
        }
    }
    return signal_.value(x.data(), gradient.data());
}

void ControlWire::add(const std::array<MatrixOut*, 5>& blocks, Eigen::Index row, double factor,
                      const std::array<double, ControlSignal::max_sources>& gradient) const {
    for (std::size_t i = 0; i < ends_.size(); ++i)
        (*entry(blocks, static_cast<int>(ends_[i].block)))(row, ends_[i].at) += factor * gradient.at(i);
}

void ControlWire::add_to_Q(ElementJacobian& d, Eigen::Index row, double factor,
                           const std::array<double, ControlSignal::max_sources>& gradient) const {
    add({&d.Q_q, &d.Q_qd, &d.Q_s, &d.Q_others, &d.Q_u}, row, factor, gradient);
}

void ControlWire::add_to_f(ElementJacobian& d, Eigen::Index row, double factor,
                           const std::array<double, ControlSignal::max_sources>& gradient) const {
    add({&d.f_q, &d.f_qd, &d.f_s, &d.f_others, &d.f_u}, row, factor, gradient);
}

}  // namespace cardan
