#include "solvers/atlas/atlas.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr const char* in_atlas = "atlas of charts";

bool has(const Model& model, const std::string& coordinate) {
    const CoordinateTable& table = model.coordinates();
    return std::any_of(table.begin(), table.end(), [&](const CoordinateInfo& c) { return c.name == coordinate; });
}

}  // namespace

AtlasIntegrator::AtlasIntegrator(std::vector<Chart> charts, std::string frame, double time, const Vector& q,
                                 const Vector& qd, double min_quality)
    : charts_(std::move(charts)), frame_(std::move(frame)), min_quality_(min_quality) {
    if (charts_.size() < 2) throw InputError(in_atlas, "number of charts", charts_.size(), ">= 2");
    if (!(min_quality > 0 && min_quality < 1))
        throw InputError(in_atlas, "minimum quality", min_quality, "between 0 and 1");
    for (std::size_t k = 0; k < charts_.size(); ++k)
        if (!charts_[k].system) throw InputError(in_atlas, text("system of chart ", k), "none", "one");
    for (const Chart& chart : charts_) chart.system->require_no_loops(in_atlas);
    for (std::size_t k = 0; k < charts_.size(); ++k) {
        const Model& model = charts_[k].system->model;
        own_.emplace_back();
        for (int i = 0; i < model.size(); ++i)
            for (const Chart& other : charts_)
                if (!has(other.system->model, model.coordinates()[i].name)) {
                    own_.back().push_back(i);
                    break;
                }
        (void)chart_quality(model, Vector::Zero(model.size()), frame_, own_.back());  // does it exist, do they move it?
        watch(k);
    }
    integrator_ = std::make_unique<Integrator>(system(), charts_[0].drives, time, q, qd, charts_[0].options);
}

double AtlasIntegrator::quality(std::size_t chart, const Vector& q) const {
    return chart_quality(charts_[chart].system->model, q, frame_, own_[chart]);
}

// The event only makes a note: the step is completed first, so that the change is not made from interpolated values.
void AtlasIntegrator::watch(std::size_t chart) {
    IntegrationOptions& options = charts_[chart].options;
    options.events.push_back(
        {.name = "quality of the chart",
         .function = [this, chart](const StateView& at) { return quality(chart, at.q) - min_quality_; },
         .direction = -1,
         .action =
             [this](Integrator&) {
                 poor_ = true;
                 return AfterEvent::proceed;
             }});
    options.cancelled = [this, own = options.cancelled] { return poor_ || (own && own()); };
}

Advance AtlasIntegrator::advance(double time) {
    for (;;) {
        Advance result = integrator_->advance(time);
        if (!poor_ || result.end != Advance::End::cancelled) return result;
        poor_ = false;
        change();
    }
}

void AtlasIntegrator::change() {
    const Checkpoint here = integrator_->checkpoint();
    std::size_t best = now_;
    double max = quality(now_, here.q);
    ChartState state;
    for (std::size_t k = 0; k < charts_.size(); ++k) {
        if (k == now_) continue;
        ChartState there;
        try {
            there = change_of_chart(system().model, {here.q, here.qd}, charts_[k].system->model, {frame_});
        } catch (const NumericalError&) {
            continue;  // it is singular here, or does not reach this place
        }
        if (const double value = quality(k, there.q); value > max) {
            best = k;
            max = value;
            state = std::move(there);
        }
    }
    if (best == now_) return;
    Checkpoint next = here;
    next.q = state.q;
    next.qd = state.qd;
    now_ = best;
    ++changes_;
    integrator_ = std::make_unique<Integrator>(system(), charts_[best].drives, next, charts_[best].options);
}

}  // namespace cardan::solvers
