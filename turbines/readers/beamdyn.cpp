#include "turbines/readers/beamdyn.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/matrix_blade.hpp"

namespace cardan::turbines {

namespace {

// Reference line and twist.
MatrixBlade key_points(OpenFastFile& file) {
    const int count = file.integer("kp_total", 2, 100000), members = file.integer("member_total", 1, count - 1);
    file.pass_over("kp_total", static_cast<std::size_t>(members));  // numbers of key points
    if (members > 1) file.note("member_total", "one smooth line goes through all key points here");
    if (count < 4) file.note("kp_total", "so few key points are joined by straight pieces here");
    // By their order: the names have changed.
    const OpenFastTable t = file.table("kp_x*", static_cast<std::size_t>(count));
    if (t.columns.size() < 4) throw ParseError(t.file, t.line, 0, "columns x, y, z and twist of key points expected");
    const auto &x = t.columns[0], &y = t.columns[1], &z = t.columns[2], &twist = t.columns[3];
    MatrixBlade blade;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        blade.points.emplace_back(x[i], y[i], z[i]);
        constexpr double largest = 1e5, rounding = 1e-9;  // m; of the blade's length
        if (blade.points[i].cwiseAbs().maxCoeff() > largest)
            t.fail(i, text("key point (", x[i], ", ", y[i], ", ", z[i], "); allowed: up to ", largest, " m"));
        if (i == 0) {
            if (blade.points[0].norm() > rounding * std::abs(z.back()))
                t.fail(0, "first key point; allowed: the blade root (0, 0, 0)");
            blade.points[0].setZero();
        }
        if (i > 0 && !(z[i] > z[i - 1]))
            t.fail(i, text(t.names[2], " = ", z[i], " after ", z[i - 1], "; allowed: larger"));
        if (std::abs(twist[i]) > 180) t.fail(i, text(t.names[3], " = ", twist[i], "; allowed: -180 ... 180 degrees"));
        blade.twist.push_back(twist[i] * units::degree);
    }
    return blade;
}

void read_stations(OpenFastFile& file, MatrixBlade& out) {
    const int count = file.integer("station_total", 2, 100000);
    const std::vector<OpenFastFile::Row> rows = file.rows_below("Distributed Properties");
    std::size_t next = 0;
    const auto row = [&](std::size_t size, const std::string& what) -> const OpenFastFile::Row& {
        const int line = rows.empty() ? 1 : rows[std::min(next, rows.size() - 1)].line;
        if (next >= rows.size())
            throw ParseError(file.name(), line, 0, text(what, ": no further row of numbers after this line"));
        file.require(rows[next], size, what);
        return rows[next++];
    };
    const auto matrix = [&](const std::string& what) {
        Mat6 m;
        for (Eigen::Index i = 0; i < 6; ++i) {
            const OpenFastFile::Row& r = row(6, text(what, ", row ", i + 1));
            m.row(i) = Eigen::Map<const Eigen::Matrix<double, 1, 6>>(r.values.data());
        }
        return m;
    };
    for (int i = 0; i < count; ++i) {
        const std::string where = text("station ", i + 1, " of ", count);
        const OpenFastFile::Row& place = row(1, where + ", place");
        if (place.values.size() >= 6)
            throw ParseError(file.name(), place.line, 0, text(where, ", place: 1 number expected, found a row of 6"));
        const double eta = place.values[0];
        const bool last = i + 1 == count;
        if ((i == 0 && eta != 0) || (last && std::abs(eta - 1) > 1e-9) || (i > 0 && !(eta > out.eta.back())))
            throw ParseError(file.name(), place.line, 0,
                             text(where, ", place = ", eta, "; allowed: from 0 to 1, increasing"));
        out.eta.push_back(eta);
        SectionMatrices m;
        m.stiffness = matrix(where + ", stiffness");
        m.mass = matrix(where + ", mass");
        try {
            static_cast<void>(beam_section(rotated(m, beamdyn_axes()), where));
        } catch (const InputError& error) {
            throw ParseError(file.name(), place.line, 0, error.what());
        }
        out.matrices.push_back(m);
    }
    if (next < rows.size() && !rows[next].values.empty())
        throw ParseError(file.name(), rows[next].line, 0,
                         text("more numbers after the ", count, " stations announced"));
}

BeamDamping damping(OpenFastFile& file) {
    const int type = file.integer("damp_type", 0, 2);
    if (type != 1 && file.has("mu2")) file.pass_over("mu2", 2);  // units and numbers
    if (type == 0) return {};
    if (type == 1) {
        const std::vector<OpenFastFile::Row> rows = file.rows_below("mu1");
        if (rows.empty()) file.fail("damp_type", "one row of six numbers expected below mu1 ... mu6");
        file.require(rows[0], 6, "mu1 ... mu6");
        const std::vector<double> mu(rows[0].values.begin(),
                                     rows[0].values.begin() + 6);  // shear x, y, extension, bending about x, y, torsion
        for (double value : mu)
            if (value < 0) throw ParseError(file.name(), rows[0].line, 0, text("mu = ", value, "; allowed: >= 0"));
        BeamDamping d;
        d.time_constants = {mu[2], mu[1], mu[0], mu[5], mu[4], mu[3]};
        return d;
    }
    const int modes = file.integer("n_modes", 1, 1000);
    const std::vector<double> zeta = file.numbers("zeta", static_cast<std::size_t>(modes));
    for (double value : zeta)
        if (value < 0) file.fail("zeta", text("zeta = ", value, "; allowed: >= 0"));
    ModalRatios ratios;
    ratios.all = zeta;
    return BeamDamping::of_modes(ratios);
}

const std::vector<KeywordGroup>& ignored_by_beamdyn() {
    static const std::vector<KeywordGroup> all{
        {{"Echo",     "analysis_type", "QuasiStaticInit", "rhoinf",   "quadrature", "refine",    "n_fact",
          "DTBeam",   "load_retries",  "NRMax",           "stop_tol", "tngt_stf_*", "RotStates", "order_elem",
          "SumPrint", "OutFmt",        "NNodeOuts",       "OutNd",    "OutList",    "BldNd_*"},
         "output and numerical settings: without meaning for the machine"},
        {{"PitchJ", "PitchK", "PitchC"}, "of a pitch drive that is off"},
        {{"n_modes", "zeta", "mu2"}, "of a kind of damping that is not chosen"}};
    return all;
}

}  // namespace

BeamDynBlade read_beamdyn(const std::filesystem::path& path) {
    OpenFastFile file = OpenFastFile::read(path);
    MatrixBlade data = key_points(file);
    const std::filesystem::path blade_path = file.path("BldFile");
    OpenFastFile blade = OpenFastFile::read(blade_path);
    read_stations(blade, data);
    BeamDynBlade out;
    out.beam.line = file.checked("kp_total", [&] { return beam_line(matrix_blade_table("blade", data)); });
    out.beam.damping = damping(blade);
    if (file.flag("UsePitchAct")) {
        out.pitch = {file.positive("PitchK"), file.not_negative("PitchC")};
        out.pitch_inertia = file.not_negative("PitchJ");
    }
    for (OpenFastFile* each : {&file, &blade})
        for (FileNote& note : each->notes(ignored_by_beamdyn())) out.beam.notes.push_back(std::move(note));
    out.beam.source = text(file.text(), "\n# ", blade_path.string(), "\n", blade.text());
    return out;
}

}  // namespace cardan::turbines
