/// @file
/// Elements with states from one formula, written for any scalar: derivatives by complex step, exact to rounding.
#pragma once

#include "elements/controllers/control_signal.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/system/force_element.hpp"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace cardan::detail {

/// Values that a law sees; `demands` are signals.
template <class S>
struct LawInput {
    double time;
    const S *q, *qd, *s, *demands;
};

/// Law: template <class S> void operator()(const LawInput<S>&, S* Q, S* f) const, with Q and f zero before. It depends
/// on the coordinates that the element has named when this is made, on its own states and on demands.
template <class Law>
class LawFunctions {
public:
    static constexpr std::size_t max = 32;  ///< values that the law sees

    LawFunctions(Law law, const std::vector<ControlSignal>& demands, ForceElement& element)
        : law_(std::move(law)), coordinates_(element.coordinates.size()), states_(element.states.size()) {
        for (const ControlSignal& demand : demands) demands_.emplace_back(demand, element);
    }

    void rates(const ElementView& in, VectorOut& Q, VectorOut& f) const {
        Gradients gradients;
        const std::array<double, max> x = values<double>(in, gradients);
        std::array<double, max> out{};
        law_(at(in.time, x), out.data(), out.data() + coordinates_);
        for (std::size_t row = 0; row < coordinates_; ++row) Q(index(row)) += out[row];
        for (std::size_t row = 0; row < states_; ++row) f(index(row)) += out[coordinates_ + row];
    }

    void jacobian(const ElementView& in, ElementJacobian& d) const {
        constexpr double step = 1e-40;
        Gradients gradients;
        std::array<Complex, max> x = values<Complex>(in, gradients);
        for (std::size_t column = 0; column < 2 * coordinates_ + states_ + demands_.size(); ++column) {
            x[column] += Complex(0, step);
            std::array<Complex, max> out{};
            law_(at(in.time, x), out.data(), out.data() + coordinates_);
            x[column] = x[column].real();
            for (std::size_t row = 0; row < coordinates_ + states_; ++row)
                add(d, row, column, out[row].imag() / step, gradients);
        }
    }

    const Law& law() const { return law_; }
    /// Values as the law sees them.
    template <class S>
    std::array<S, max> values(const ElementView& in) const {
        Gradients gradients;
        return values<S>(in, gradients);
    }
    template <class S>
    LawInput<S> at(double time, const std::array<S, max>& x) const {
        const S* p = x.data();
        return {time, p, p + coordinates_, p + 2 * coordinates_, p + 2 * coordinates_ + states_};
    }

private:
    using Gradient = std::array<double, ControlSignal::max_sources>;
    using Gradients = std::array<Gradient, 4>;

    static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

    template <class S>
    std::array<S, max> values(const ElementView& in, Gradients& gradients) const {
        std::array<S, max> x{};
        std::size_t n = 0;
        for (std::size_t i = 0; i < coordinates_; ++i) x[n++] = in.q(index(i));
        for (std::size_t i = 0; i < coordinates_; ++i) x[n++] = in.qd(index(i));
        for (std::size_t i = 0; i < states_; ++i) x[n++] = in.s(index(i));
        for (std::size_t i = 0; i < demands_.size(); ++i) x[n++] = demands_[i].value(in, gradients[i]);
        return x;
    }
    // A derivative by one of the values.
    void add(ElementJacobian& d, std::size_t row, std::size_t column, double slope, const Gradients& gradients) const {
        const bool force = row < coordinates_;
        const Eigen::Index at = index(force ? row : row - coordinates_);
        if (column < coordinates_)
            (force ? d.Q_q : d.f_q)(at, index(column)) += slope;
        else if (column < 2 * coordinates_)
            (force ? d.Q_qd : d.f_qd)(at, index(column - coordinates_)) += slope;
        else if (column < 2 * coordinates_ + states_)
            (force ? d.Q_s : d.f_s)(at, index(column - 2 * coordinates_)) += slope;
        else {
            const std::size_t demand = column - 2 * coordinates_ - states_;
            if (force)
                demands_[demand].add_to_Q(d, at, slope, gradients[demand]);
            else
                demands_[demand].add_to_f(d, at, slope, gradients[demand]);
        }
    }

    Law law_;
    std::size_t coordinates_, states_;
    std::vector<ControlWire> demands_;
};

/// Gives the element the functions of a law; its power too, if it tells it by ElementPower power(const
/// LawInput<double>&).
template <class Law>
void set_law(ForceElement& element, Law law, const std::vector<ControlSignal>& demands = {}) {
    const auto functions = std::make_shared<const LawFunctions<Law>>(std::move(law), demands, element);
    element.evaluate = [functions](const ElementView& in, ElementForces& out) { functions->rates(in, out.Q, out.f); };
    element.jacobian = [functions](const ElementView& in, ElementJacobian& d) { functions->jacobian(in, d); };
    if constexpr (requires(const LawInput<double>& at) { functions->law().power(at); })
        element.power = [functions](const ElementView& in) {
            const auto x = functions->template values<double>(in);
            return functions->law().power(functions->at(in.time, x));
        };
}

}  // namespace cardan::detail
