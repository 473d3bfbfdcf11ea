#include "turbines/yaml/detail/windio_beams.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"
#include "turbines/readers/detail/matrix_blade.hpp"
#include "turbines/yaml/detail/windio_curve.hpp"

#include <algorithm>
#include <array>

namespace cardan::turbines {

namespace {

using Curve = WindioCurve;

// Matrices over a grid.
struct MatrixCurve {
    std::vector<double> grid;
    std::vector<Mat6> values;
    Mat6 at(double place) const {
        StationPlace at = place_among(grid, place);
        at.t = std::clamp(at.t, 0.0, 1.0);
        return at.of(values);
    }
};

// Version 1: the 21 entries of the upper triangle, row by row.
MatrixCurve triangles(const YamlNode& node) {
    MatrixCurve out;
    const YamlNode values = node["values"];
    for (const YamlNode& row : values.items()) {
        const std::vector<double> entries = row.numbers(std::size_t{21});
        Mat6 m;
        std::size_t k = 0;
        for (Eigen::Index i = 0; i < 6; ++i)
            for (Eigen::Index j = i; j < 6; ++j) m(i, j) = m(j, i) = entries[k++];
        out.values.push_back(m);
    }
    out.grid = increasing_grid(node["grid"], out.values.size());
    return out;
}

// A list of `count` numbers; zeros where the schema leaves it out.
std::vector<double> numbers_or_zeros(const YamlNode& node, std::string_view key, std::size_t count) {
    const auto list = node.find(key);
    return list ? list->numbers(count) : std::vector<double>(count, 0.0);
}

// Of the schema only bending, K44 and K55, has to be there.
constexpr std::array<Eigen::Index, 4> rigid_if_missing{0, 1, 2, 5};
constexpr std::array<const char*, 4> direction_names{"shear along x", "shear along y", "extension", "torsion"};

bool has_to_be_there(Eigen::Index i) {
    return std::find(rigid_if_missing.begin(), rigid_if_missing.end(), i) == rigid_if_missing.end();
}

// Version 2: a list of every entry K11 ... K66; couplings may be left out.
MatrixCurve named_stiffness(const YamlNode& node) {
    MatrixCurve out;
    out.values.assign(node["grid"].items().size(), Mat6::Zero());
    out.grid = increasing_grid(node["grid"], out.values.size());
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = i; j < 6; ++j) {
            const std::string key = text("K", i + 1, j + 1);
            const std::vector<double> entry = i == j && has_to_be_there(i)
                                                  ? node[key].numbers(out.grid.size())
                                                  : numbers_or_zeros(node, key, out.grid.size());
            for (std::size_t k = 0; k < entry.size(); ++k) out.values[k](i, j) = out.values[k](j, i) = entry[k];
        }
    return out;
}

MatrixCurve named_inertia(const YamlNode& node) {
    MatrixCurve out;
    const std::vector<double> mass = node["mass"].numbers();
    out.grid = increasing_grid(node["grid"], mass.size());
    const auto list = [&](const char* key) { return numbers_or_zeros(node, key, mass.size()); };
    const std::vector<double> x = list("cm_x"), y = list("cm_y"), edge = list("i_edge"), flap = list("i_flap"),
                              polar = list("i_plr"), product = list("i_cp");
    for (std::size_t k = 0; k < mass.size(); ++k) {
        Mat6 m = Mat6::Zero();
        m.diagonal() << mass[k], mass[k], mass[k], edge[k], flap[k], polar[k];
        m(0, 5) = m(5, 0) = -mass[k] * y[k];
        m(1, 5) = m(5, 1) = mass[k] * x[k];
        m(2, 3) = m(3, 2) = mass[k] * y[k];
        m(2, 4) = m(4, 2) = -mass[k] * x[k];
        m(3, 4) = m(4, 3) = -product[k];
        out.values.push_back(m);
    }
    return out;
}

// Over both grids.
struct Matrices {
    std::vector<double> eta;
    std::vector<SectionMatrices> values;
};

// What has no stiffness (or, of torsion, no inertia) anywhere is not soft, but was not computed.
void make_rigid(Matrices& sections, WindioFile& file, const YamlNode& stiffness) {
    std::string rigid;
    const auto everywhere = [&](const auto& is_so) {
        return std::all_of(sections.values.begin(), sections.values.end(), is_so);
    };
    for (std::size_t k = 0; k < rigid_if_missing.size(); ++k) {
        const Eigen::Index i = entry(rigid_if_missing, k);
        const bool soft = everywhere([&](const SectionMatrices& m) { return m.stiffness.row(i).isZero(0); });
        // A torsion without inertia moves nothing; the inertia about the axis is that about x and y.
        const bool massless =
            i == 5 && everywhere([](const SectionMatrices& m) { return m.mass.bottomRightCorner<3, 3>().isZero(0); });
        if (!soft && !massless) continue;
        for (SectionMatrices& m : sections.values) {
            m.stiffness.row(i).setZero();
            m.stiffness.col(i).setZero();
            m.stiffness(i, i) = std::numeric_limits<double>::infinity();
        }
        rigid += (rigid.empty() ? "" : ", ") + std::string(entry(direction_names, k));
    }
    if (!rigid.empty()) file.note(stiffness, "", text("rigid, since no stiffness or no inertia is given: ", rigid));
}

// Public files that older versions of WISDEM wrote have the edgewise inertia twice, the second time in the place of the
// product, and none flapwise. The polar inertia, the sum of both, is right.
void restore_flap_inertia(MatrixCurve& inertia, WindioFile& file, const YamlNode& node) {
    const auto everywhere = [&](const auto& is_so) { return std::ranges::all_of(inertia.values, is_so); };
    const bool no_flap =
        everywhere([](const Mat6& m) { return m(0, 0) > 0 && m(4, 4) == 0 && m(3, 3) > 0 && m(5, 5) > m(3, 3); });
    const bool twice = everywhere([](const Mat6& m) { return m(3, 4) == m(3, 3); });
    if (!no_flap || !(twice || everywhere([](const Mat6& m) { return m(3, 4) == 0; }))) return;
    for (Mat6& m : inertia.values) {
        m(4, 4) = m(5, 5) - m(3, 3);
        m(3, 4) = m(4, 3) = m(0, 5) * m(1, 5) / m(0, 0);  // - mass x y: none about the mass centre
    }
    file.note(
        node, "",
        text("the flapwise inertia is zero", twice ? ", and the edgewise stands in the place of the product" : "",
             ": it is taken as the polar less the edgewise inertia, and the product about the mass centre as zero"));
}

Matrices read_matrices(WindioFile& file, const YamlNode& stiffness, const YamlNode& inertia) {
    const MatrixCurve K = stiffness.find("values") ? triangles(stiffness) : named_stiffness(stiffness);
    MatrixCurve M = inertia.find("values") ? triangles(inertia) : named_inertia(inertia);
    restore_flap_inertia(M, file, inertia);
    Matrices out;
    out.eta = united(K.grid, M.grid);
    for (double at : out.eta) out.values.push_back({K.at(at), M.at(at)});
    make_rigid(out, file, stiffness);
    return out;
}

// The entries of mu in the order of strains (see BeamDamping).
BeamDamping damping_of(WindioFile& file, const std::optional<YamlNode>& given, const char* part,
                       const std::array<std::size_t, 6>& order) {
    BeamDamping damping;
    if (!given) return damping;
    const auto list = given->find("mu");
    if (!list) {
        file.note(*given, "", text("only damping by mu is read: the ", part, " has none"));
        return damping;
    }
    const std::vector<double> mu = list->numbers(std::size_t{6});
    for (std::size_t i = 0; i < 6; ++i) {
        if (mu[i] < 0) list->fail(text(mu[i], "; allowed: >= 0"));
        damping.time_constants.at(i) = mu[order.at(i)];
    }
    return damping;
}

// Points at the places of all three grids.
std::vector<Vec3> axis_points(const YamlNode& node) {
    const Curve x = whole_curve(node["x"]), y = whole_curve(node["y"]), z = whole_curve(node["z"]);
    std::vector<Vec3> points;
    for (double at : united(united(x.grid, y.grid), z.grid)) points.emplace_back(x.at(at), y.at(at), z.at(at));
    for (std::size_t i = 1; i < points.size(); ++i)
        if (!(points[i](2) > points[i - 1](2)))
            node["z"].fail(text(points[i](2), " m after ", points[i - 1](2), " m; allowed: larger"));
    return points;
}

YamlNode blade_axis(const WindioFile& file) {
    return file.get({"components.blade.reference_axis",
                     "components.blade.elastic_properties_mb.six_x_six.reference_axis",
                     "components.blade.outer_shape_bem.reference_axis"});
}

std::optional<YamlNode> blade_matrices(const WindioFile& file) {
    return file.find({"components.blade.structure.elastic_properties", "components.blade.elastic_properties",
                      "components.blade.elastic_properties_mb.six_x_six", "components.blade.elastic_properties_mb"});
}

}  // namespace

bool windio_has_sections(const WindioFile& file) {
    const auto elastic = blade_matrices(file);
    return elastic && (elastic->find("stiffness_matrix") || elastic->find("stiff_matrix")) &&
           elastic->find("inertia_matrix");
}

double windio_blade_length(const WindioFile& file) {
    const YamlNode z = blade_axis(file)["z"];
    const double length = z["values"].numbers().back() - z["values"].numbers().front();
    if (!(length > 0)) z.fail(text("a length of ", length, " m; allowed: > 0"));
    return length;
}

BeamTable windio_blade(WindioFile& file) {
    const YamlNode axis = blade_axis(file);
    MatrixBlade blade;
    blade.points = axis_points(axis);
    const Vec3 root = blade.points.front();
    for (Vec3& p : blade.points) p -= root;
    const YamlNode twist =
        file.get({"components.blade.outer_shape.twist", "components.blade.elastic_properties_mb.six_x_six.twist",
                  "components.blade.outer_shape_bem.twist"});
    const Curve angle = whole_curve(twist);
    blade.twist_at = angle.grid;
    for (double value : angle.values) {
        if (std::abs(value * file.angle()) > pi)
            twist.fail(text("twist of ", value, "; allowed: half a turn at most (", file.unit_of_angle(), ")"));
        blade.twist.push_back(value * file.angle());
    }
    const YamlNode elastic = *blade_matrices(file);
    const std::optional<YamlNode> named = elastic.find("stiffness_matrix");
    Matrices sections = read_matrices(file, named ? *named : elastic["stiff_matrix"], elastic["inertia_matrix"]);
    blade.eta = std::move(sections.eta);
    blade.matrices = std::move(sections.values);
    try {
        BeamTable table = matrix_blade_table("blade", blade);
        static_cast<void>(beam_line(table));
        return table;
    } catch (const InputError& error) {
        elastic.fail(error.what());
    }
}

// Axes of the blade: x downwind, y to the trailing edge, z to the tip; in those of the beam (z, -y, x).
BeamDamping windio_blade_damping(WindioFile& file) {
    const auto given = file.find({"components.blade.structure.elastic_properties.structural_damping",
                                  "components.blade.elastic_properties.structural_damping",
                                  "components.blade.elastic_properties_mb.six_x_six.structural_damping"});
    return damping_of(file, given, "blade", {2, 1, 0, 5, 4, 3});
}

namespace {

struct Material {
    double E, G, density;
};

Material material(WindioFile& file, const YamlNode& name) {
    const YamlNode all = file.get({"materials"});
    for (const YamlNode& m : all.items()) {
        if (m["name"].word() != name.word()) continue;
        const YamlNode E = m["E"], density = m["rho"];
        if (E.is_list()) E.fail(text("several values; allowed: one, '", name.word(), "' is used for the tower"));
        Material out{E.number(), 0, density.number()};
        if (!(out.E > 0)) E.fail(text(out.E, "; allowed: > 0"));
        if (!(out.density > 0)) density.fail(text(out.density, "; allowed: > 0"));
        const auto G = m.find("G"), nu = m.find("nu");
        out.G = G && !G->is_list() ? G->number() : out.E / (2 * (1 + (nu && !nu->is_list() ? nu->number() : 0.3)));
        if (!(out.G > 0)) m.fail(text("shear modulus ", out.G, "; allowed: > 0"));
        return out;
    }
    name.fail(text("no material '", name.word(), "'"));
}

struct Layer {
    Material material;
    Curve thickness;
};

// A tube of layers, the first outside.
EngineeringSection tube_section(double diameter, const std::vector<Layer>& layers, double at, double mass_factor,
                                const YamlNode& where) {
    EngineeringSection s;
    s.EA = s.GJ = s.GA_y = s.GA_z = 0;
    double outer = diameter / 2;
    for (const Layer& layer : layers) {
        const double t = layer.thickness.at(at), inner = outer - t;
        if (!(t >= 0 && inner >= 0)) where.fail(text("wall of ", t, " m at ", at, "; allowed: 0 ... ", outer));
        const double area = pi * (outer * outer - inner * inner),
                     I = pi / 4 * (std::pow(outer, 4) - std::pow(inner, 4));
        const Material& m = layer.material;
        s.mass += mass_factor * m.density * area;
        s.EA += m.E * area;
        s.GJ += 2 * m.G * I;
        s.EI_flap += m.E * I;
        s.GA_y += m.G * area / 2;
        s.j_flap += mass_factor * m.density * I;
        outer = inner;
    }
    if (!(s.EI_flap > 0)) where.fail(text("no wall at ", at));
    s.EI_edge = s.EI_flap;
    s.GA_z = s.GA_y;
    s.j_edge = s.j_flap;
    return s;
}

// Stations of a tube of layers.
void add_tube(BeamTable& table, WindioFile& file, double length) {
    const YamlNode shape =
        file.get({"components.tower.outer_shape.outer_diameter", "components.tower.outer_shape_bem.outer_diameter"});
    const Curve diameter = whole_curve(shape);
    const YamlNode list =
        file.get({"components.tower.structure.layers", "components.tower.internal_structure_2d_fem.layers"});
    const auto factor = file.find({"components.tower.structure.outfitting_factor",
                                   "components.tower.internal_structure_2d_fem.outfitting_factor"});
    const double mass_factor = factor ? factor->number() : 1;
    if (!(mass_factor > 0)) factor->fail(text(mass_factor, "; allowed: > 0"));
    std::vector<double> grid = diameter.grid;
    std::vector<Layer> layers;
    for (const YamlNode& layer : list.items()) {
        layers.push_back({material(file, layer["material"]), whole_curve(layer["thickness"])});
        grid = united(grid, layers.back().thickness.grid);
    }
    constexpr int parts = 8;
    for (std::size_t i = 1; i < grid.size(); ++i)
        for (int k = i == 1 ? 0 : 1; k <= parts; ++k) {
            const double at = grid[i - 1] + (grid[i] - grid[i - 1]) * k / parts;
            table.stations.push_back(at * length);
            table.sections.push_back(tube_section(diameter.at(at), layers, at, mass_factor, shape));
        }
}

// Axes of the tower: x downwind, y to the left, z up; in those of the beam (z, x, y).
void add_matrices(BeamTable& table, WindioFile& file, const YamlNode& stiffness, const YamlNode& inertia,
                  double length) {
    Mat3 R;
    R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const Matrices sections = read_matrices(file, stiffness, inertia);
    if (sections.eta.front() > 1e-9 || sections.eta.back() < 1 - 1e-9)
        stiffness.fail(text("places ", sections.eta.front(), " ... ", sections.eta.back(), "; allowed: 0 ... 1"));
    for (double at : sections.eta) table.stations.push_back(at * length);
    table.stations.back() = length;
    for (const SectionMatrices& section : sections.values) table.matrices.push_back(rotated(section, R));
    table.beta.assign(table.stations.size(), 0.0);
    try {
        static_cast<void>(beam_line(table));
    } catch (const InputError& error) {
        stiffness.fail(error.what());
    }
}

// Some files have bending and torsion only, and none of the inertias.
bool is_whole(const YamlNode& stiffness, const YamlNode& inertia) {
    const auto has = [](const YamlNode& node, const char* key) { return node.find(key).has_value(); };
    return (has(stiffness, "values") || (has(stiffness, "K11") && has(stiffness, "K22") && has(stiffness, "K33"))) &&
           (has(inertia, "values") || has(inertia, "i_plr"));
}

}  // namespace

BeamTable windio_tower(WindioFile& file) {
    const YamlNode axis =
        file.get({"components.tower.reference_axis", "components.tower.elastic_properties_mb.six_x_six.reference_axis",
                  "components.tower.outer_shape_bem.reference_axis"});
    const std::vector<Vec3> points = axis_points(axis);
    for (const Vec3& p : points)
        if (p(0) != points[0](0) || p(1) != points[0](1)) axis.fail("a tower that leans; allowed: x and y constant");
    const double length = points.back()(2) - points.front()(2);
    BeamTable table;
    table.name = "tower";
    const auto stiffness = file.find({"components.tower.structure.elastic_properties.stiffness_matrix",
                                      "components.tower.elastic_properties.stiffness_matrix",
                                      "components.tower.elastic_properties_mb.six_x_six.stiff_matrix"});
    const auto inertia = file.find({"components.tower.structure.elastic_properties.inertia_matrix",
                                    "components.tower.elastic_properties.inertia_matrix",
                                    "components.tower.elastic_properties_mb.six_x_six.inertia_matrix"});
    const bool has_layers =
        file.find({"components.tower.structure.layers", "components.tower.internal_structure_2d_fem.layers"})
            .has_value();
    if (stiffness && inertia && (!has_layers || is_whole(*stiffness, *inertia))) {
        add_matrices(table, file, *stiffness, *inertia, length);
        return table;
    }
    if (stiffness)
        file.note(*stiffness, "", "without shear or axial stiffness or inertias: the tower is that of its layers");
    add_tube(table, file, length);
    return table;
}

BeamDamping windio_tower_damping(WindioFile& file) {
    const auto given = file.find({"components.tower.structure.elastic_properties.structural_damping",
                                  "components.tower.elastic_properties.structural_damping",
                                  "components.tower.elastic_properties_mb.six_x_six.structural_damping"});
    return damping_of(file, given, "tower", {2, 0, 1, 5, 3, 4});
}

}  // namespace cardan::turbines
