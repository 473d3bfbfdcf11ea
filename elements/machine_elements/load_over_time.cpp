#include "elements/machine_elements/load_over_time.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace cardan {

namespace {

struct LoadTable {
    std::vector<double> times;
    std::vector<Wrench> rows;

    Wrench at(double time) const {
        StationPlace place = place_among(times, time);
        place.t = std::clamp(place.t, 0.0, 1.0);
        const Wrench &a = rows[place.left], &b = rows[place.right];
        return {(1 - place.t) * a.force + place.t * b.force, (1 - place.t) * a.moment + place.t * b.moment};
    }
    // Change per second after a row; none before the first (-1) and after the last.
    Vec6 slope_after(std::ptrdiff_t row) const {
        if (row < 0 || row + 1 >= std::ssize(times)) return Vec6::Zero();
        const auto i = static_cast<std::size_t>(row);
        const double duration = times[i + 1] - times[i];
        return (Vec6() << (rows[i + 1].force - rows[i].force) / duration,
                (rows[i + 1].moment - rows[i].moment) / duration)
            .finished();
    }
    std::vector<double> breaks() const {
        std::vector<double> found;
        for (std::ptrdiff_t row = 0; row < std::ssize(times); ++row)
            if (slope_after(row - 1) != slope_after(row)) found.push_back(times[static_cast<std::size_t>(row)]);
        return found;
    }
};

void check(const std::string& where, const LoadTable& table) {
    if (table.times.size() != table.rows.size())
        throw InputError(where, "numbers of times and of rows", text(table.times.size(), ", ", table.rows.size()),
                         "as many of one as of the other");
    if (table.times.size() < 2) throw InputError(where, "number of rows", table.times.size(), ">= 2");
    for (std::size_t i = 0; i < table.times.size(); ++i) {
        const std::string row = text(where, ", row ", i + 1);
        const double time = table.times[i];
        if (!std::isfinite(time)) throw InputError(row, "time [s]", time, "finite");
        if (i > 0 && !(time > table.times[i - 1]))
            throw InputError(row, "time [s]", time, text("> ", table.times[i - 1], ", that of the row before"));
        const auto& [force, moment] = table.rows[i];
        if (!force.allFinite()) throw InputError(row, "force [N]", force.transpose(), "finite");
        if (!moment.allFinite()) throw InputError(row, "moment [N m]", moment.transpose(), "finite");
    }
}

}  // namespace

FrameLoad load_over_time(std::string name, FrameId frame, std::vector<double> times, std::vector<Wrench> rows,
                         WrenchAxes axes) {
    LoadTable table{std::move(times), std::move(rows)};
    check(text("load '", name, "'"), table);
    FrameLoad load{.name = std::move(name), .frame = frame, .axes = axes};
    load.breaks = table.breaks();
    load.over_time = [shared = std::make_shared<const LoadTable>(std::move(table))](double time) {
        return shared->at(time);
    };
    return load;
}

FrameLoad force_over_time(std::string name, FrameId frame, std::vector<double> times, const std::vector<Vec3>& forces,
                          WrenchAxes axes) {
    std::vector<Wrench> rows;
    rows.reserve(forces.size());
    for (const Vec3& force : forces) rows.push_back({force, Vec3::Zero()});
    return load_over_time(std::move(name), frame, std::move(times), std::move(rows), axes);
}

}  // namespace cardan
