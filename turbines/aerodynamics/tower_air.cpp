#include "turbines/aerodynamics/tower_air.hpp"

#include "mbs/base/borrowed.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "turbines/aerodynamics/detail/air_tower.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

// Where the air drags: a row of the tower's table, or the nacelle; axes of its body.
struct DragSite {
    int body;    // -1: the base
    Vec3 place;  // m
    Mat3 axes;   // of a row: x along the tower; of the nacelle: its own
    // C_d D of a row, m, per length; C_d A of the nacelle, m^2, by axis
    Vec3 drag;
    bool round;  // a row
};

// At a state, base axes: force, and its derivative by the air's velocity against the site.
struct DragState {
    Vec3 place, velocity, relative, force;
    Mat3 slope;
};

struct DragScratch {
    std::vector<BodyRate> rates;
    std::vector<DragState> sites;
    std::vector<Mover> movers;
    Columns6 sum_q, sum_qd;
};

}  // namespace

struct TowerAir::Parts {
    Wind wind = SteadyWind{};
    std::vector<DragSite> sites;   // rows of the tower upwards, then the nacelle
    std::vector<AirPoint> points;  // of the sites, by body, descending
    std::vector<int> path;         // bodies from the base to the highest site, ascending
    bool has_nacelle = false;

    void add_tower(const Turbine& turbine, const AeroTower& tower);
    void add_nacelle(const Turbine& turbine, const AeroNacelle& nacelle);
};

namespace {

// With V in axes of the site: across a round tower c |n| n, n the part without x, and c_i V_i |V_i| for a nacelle, both
// turning with the site.
void find_force(const DragSite& site, const Mat3& R, double density, DragState& out) {
    const Vec3 V = R.transpose() * out.relative;
    Vec3 force;
    Mat3 slope = Mat3::Zero();
    if (site.round) {
        const Vec3 n(0, V.y(), V.z());
        const double size = n.norm(), c = density / 2 * site.drag.x();
        force = c * size * n;
        slope.diagonal() << 0, c * size, c * size;
        if (size > 0) slope += c / size * n * n.transpose();
    } else {
        const Vec3 c = density / 2 * site.drag;
        force = c.cwiseProduct(V.cwiseProduct(V.cwiseAbs()));
        slope.diagonal() = 2 * c.cwiseProduct(V.cwiseAbs());
    }
    out.force = R * force;
    out.slope = R * slope * R.transpose();
}

class DragEvaluation {
public:
    DragEvaluation(const Wind& wind, const std::vector<DragSite>& sites, const std::vector<int>& path,
                   const StateView& at, DragScratch& scratch)
        : sites_(sites), path_(path), scratch_(scratch), motion_(at, path, scratch.rates), wind_(wind.at(at.time)) {
        scratch_.sites.resize(sites.size());
        for (std::size_t i = 0; i < sites.size(); ++i) {
            const DragSite& own = sites[i];
            DragState& s = scratch_.sites[i];
            s.place = motion_.place(own.body, own.place);
            s.velocity = motion_.velocity(own.body, s.place);
            s.relative = wind_.at(s.place) - s.velocity;
            find_force(own, motion_.rotation(own.body) * own.axes, wind_.density(), s);
        }
    }

    const DragState& site(std::size_t i) const { return scratch_.sites[i]; }
    Wrench wrench(const AirPoint& point) const { return {point.length * site(point.section).force, Vec3::Zero()}; }

    double power(const AirPoint& point) const {
        return wrench(point).force.dot(motion_.velocity(point.body, motion_.place(point.body, point.place)));
    }

    // The method: detail/air_derivatives.cpp.
    void add_derivatives(const std::vector<AirPoint>& points, const MatrixOut& by_q, const MatrixOut& by_qd) {
        scratch_.movers.resize(static_cast<std::size_t>(motion_.model().size()));
        for (const int a : path_) entry(scratch_.movers, a) = motion_.mover(a);
        for (Columns6* sum : {&scratch_.sum_q, &scratch_.sum_qd}) sum->setZero(6, by_q.rows());
        Vec6 wrench = Vec6::Zero();
        auto next = points.begin();
        for (std::size_t j = path_.size(); j-- > 0;) {
            const int b = path_[j];
            for (; next != points.end() && next->body == b; ++next) add_point(*next, wrench);
            add_row(motion_.model(), scratch_.movers, b, path_, scratch_.sum_q, scratch_.sum_qd, wrench, by_q, by_qd);
        }
    }

private:
    // A force f of a site: df = w x f + slope (dV - w x V), as it turns with the site.
    void add_point(const AirPoint& point, Vec6& wrench) {
        const DragState& s = site(point.section);
        const Vec3 x = motion_.place(point.body, point.place);
        const auto at_origin = [&](const Vec3& force) {
            Vec6 out;
            out << cross<double>(x, force), force;
            return Vec6(point.length * out);
        };
        wrench += at_origin(s.force);
        const Mat3 gradient = wind_.gradient_at(s.place);
        for (int j = 0; j < motion_.depth(entry(sites_, point.section).body); ++j) {
            const int a = entry(path_, j);
            const Mover& own = entry(scratch_.movers, a);
            const Vec3 v = own.at(s.place), air = gradient * v - own.change_of_velocity(s.place, s.velocity) -
                                                  cross<double>(own.w, s.relative);
            scratch_.sum_q.col(a) += at_origin(cross<double>(own.w, s.force) + s.slope * air);
            scratch_.sum_qd.col(a) += at_origin(-(s.slope * v));
        }
        for (int j = 0; j < motion_.depth(point.body); ++j) {
            const int a = entry(path_, j);
            scratch_.sum_q.col(a).head<3>() +=
                cross<double>(entry(scratch_.movers, a).at(x), Vec3(point.length * s.force));
        }
    }

    const std::vector<DragSite>& sites_;
    const std::vector<int>& path_;
    DragScratch& scratch_;
    BodyMotion motion_;
    WindAtTime wind_;
};

}  // namespace

void TowerAir::Parts::add_tower(const Turbine& turbine, const AeroTower& tower) {
    const AirLine line = air_tower(turbine, tower);
    sites.reserve(tower.height.size() + 1);
    for (std::size_t i = 0; i < tower.height.size(); ++i) {
        const RigidPiece& on = line.piece(i);
        const Placement at = on.pose(line.place(i));
        sites.push_back({on.body, at.p, at.R, Vec3(tower.diameter[i] * tower.drag[i], 0, 0), true});
        line.add_points(i, points);
    }
    const MachineLayout& layout = turbine.layout();
    path = path_to(turbine.system().model, turbine.system().model.frame(layout.tower_top).body);
}

void TowerAir::Parts::add_nacelle(const Turbine& turbine, const AeroNacelle& nacelle) {
    const Model& model = turbine.system().model;
    const auto is_nacelle = [](const Model::Frame& frame) { return frame.name == "nacelle"; };
    if (std::ranges::none_of(model.frames(), is_nacelle))
        throw InputError("air on the nacelle", "nacelle", "none", "a machine that has one");
    const FrameId carrier = model.frame("nacelle");
    const Model::Frame& frame = model.frame(carrier);
    const Vec3 place = frame.in_body * nacelle.centre;
    points.push_back({frame.body, {carrier, nacelle.centre}, place, 1, sites.size()});
    sites.push_back({frame.body, place, frame.in_body.R, nacelle.area.cwiseProduct(nacelle.drag), false});
    path = path_to(model, frame.body);
    has_nacelle = true;
}

TowerAir::TowerAir(const Turbine& turbine, const TowerNacelleAero& support, const Wind& wind) {
    support.tower.check();
    support.nacelle.check();
    const auto parts = std::make_shared<Parts>();
    parts->wind = wind;
    if (support.tower.has_loads()) parts->add_tower(turbine, support.tower);
    if (support.nacelle.has_loads()) parts->add_nacelle(turbine, support.nacelle);
    sort_by_body(parts->points);
    parts_ = parts;
}

TowerAir TowerAir::in(const Wind& wind) const {
    TowerAir other = *this;
    const auto parts = std::make_shared<Parts>(*parts_);
    parts->wind = wind;
    other.parts_ = parts;
    return other;
}

ForceElement TowerAir::element() const {
    ForceElement element{.name = "air on the tower", .breaks = parts_->wind.breaks()};
    element.points.reserve(parts_->points.size());
    for (const AirPoint& point : parts_->points) element.points.push_back(point.at);
    element.evaluate = [parts = parts_](const ElementView& at, ElementForces& out) {
        Borrowed<DragScratch> scratch;
        const DragEvaluation air(parts->wind, parts->sites, parts->path, at.system, *scratch);
        std::size_t next = 0;
        for (const AirPoint& point : parts->points) out.wrenches[next++] = air.wrench(point);
    };
    element.jacobian = [parts = parts_](const ElementView& at, ElementJacobian& out) {
        Borrowed<DragScratch> scratch;
        DragEvaluation(parts->wind, parts->sites, parts->path, at.system, *scratch)
            .add_derivatives(parts->points, out.Q_q, out.Q_qd);
    };
    return element;
}

std::vector<Vec3> TowerAir::tower(const StateView& at) const {
    Borrowed<DragScratch> scratch;
    const DragEvaluation air(parts_->wind, parts_->sites, parts_->path, at, *scratch);
    std::vector<Vec3> out(parts_->sites.size() - (parts_->has_nacelle ? 1 : 0));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = air.site(i).force;
    return out;
}

Vec3 TowerAir::nacelle(const StateView& at) const {
    if (!parts_->has_nacelle) return Vec3::Zero();
    Borrowed<DragScratch> scratch;
    const DragEvaluation air(parts_->wind, parts_->sites, parts_->path, at, *scratch);
    return air.site(parts_->sites.size() - 1).force;
}

double TowerAir::work_rate(const StateView& at) const {
    Borrowed<DragScratch> scratch;
    const DragEvaluation air(parts_->wind, parts_->sites, parts_->path, at, *scratch);
    double sum = 0;
    for (const AirPoint& point : parts_->points) sum += air.power(point);
    return sum;
}

bool TowerAir::is_empty() const {
    return parts_->sites.empty();
}

}  // namespace cardan::turbines
