#include "solvers/mode_names/energy_shares.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/mode_names/detail/blade_likeness.hpp"
#include "solvers/mode_names/detail/component_modes.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cardan::solvers {

namespace {

bool is_of_blade(const RotorMap& rotor, int coordinate) {
    return std::any_of(rotor.blades.begin(), rotor.blades.end(), [&](const std::vector<int>& blade) {
        return std::find(blade.begin(), blade.end(), coordinate) != blade.end();
    });
}

const char* ordinal_name(int n) {
    constexpr std::array names{"1st", "2nd", "3rd"};
    return n <= 3 ? entry(names, n - 1) : nullptr;
}

bool differing_blades(const Linearisation& lin, const Model& model, const RotorMap& rotor) {
    check(rotor, model);
    require_size("energy shares", "elastic stiffness", lin.elastic, model.size(), model.size());
    return !blades_alike(model, rotor, lin);
}

// Those of the map. What belongs to none of them is one part each by the names that the coordinates have, or, without a
// name, all together: a machine whose map has no parts has "1st mode", "2nd mode".
std::vector<PartAxes> all_parts(const RotorMap& rotor, const Linearisation& lin, const std::vector<int>& coordinates) {
    std::vector<PartAxes> parts = rotor.parts;
    for (const int coordinate : coordinates) {
        const std::string& part = lin.coordinates[coordinate].part;
        if (std::ranges::find(parts, part, &PartAxes::part) != parts.end()) continue;
        PartAxes own{.part = part, .axes = Tree::base(), .translation = {}, .rotation = {}};
        own.translation.fill(part.empty() ? "mode" : part);
        own.rotation = own.translation;
        parts.push_back(std::move(own));
    }
    return parts;
}

// No row is a multi-blade coordinate.
bool has_plain_blade_rows(const RotorMap& rotor, const std::vector<MultiBladeRow>& rows) {
    const auto is_multi_blade = [](const MultiBladeRow& row) { return row.blade_coordinate >= 0; };
    return rotor.blades.size() > 1 && std::none_of(rows.begin(), rows.end(), is_multi_blade);
}

}  // namespace

EnergyFractions::EnergyFractions(const Linearisation& lin, const Model& model, const RotorMap& rotor,
                                 const std::vector<int>& coordinates, const std::vector<MultiBladeRow>& rows)
    : two_blades_(rotor.blades.size() == 2),
      blades_differ_(differing_blades(lin, model, rotor)),
      plain_(has_plain_blade_rows(rotor, rows)) {
    require_count("energy shares", "rows", rows.size(), coordinates.size());
    for (const int coordinate : coordinates) require_index("energy shares", "coordinate", coordinate, model.size());
    for (const std::vector<int>& blade : rotor.blades)
        blade_numbers_.push_back(blade.empty() ? 0 : model.coordinates()[blade.front()].blade);
    const bool apart = blades_differ_ || plain_;
    for (const PartAxes& part : all_parts(rotor, lin, coordinates)) {
        if (apart) add_blades(lin, model, rotor, {part, coordinates, rows});
        Block block{}, shaft{};
        std::vector<int> own_plane;  // of rotating pairs: the one plane tells the component modes of both
        const auto at_harmonic = [this](std::vector<std::vector<int>>& lists, int harmonic) -> std::vector<int>& {
            harmonics_ = std::max(harmonics_, harmonic);
            lists.resize(std::max(lists.size(), static_cast<std::size_t>(harmonic)));
            return entry(lists, harmonic - 1);
        };
        std::vector<int> own;  // model indices: of the part, or of the part in blade 1
        bool blades = false;
        for (std::size_t i = 0; i < coordinates.size(); ++i) {
            const CoordinateInfo& info = lin.coordinates[coordinates[i]];
            if (info.part != part.part || (apart && is_of_blade(rotor, coordinates[i]))) continue;
            const int row = static_cast<int>(i);
            if (rows[i].blade_coordinate < 0 && rows[i].kind != MultiBlade::none) {
                const bool cosine = rows[i].kind == MultiBlade::cosine;
                at_harmonic(cosine ? shaft.cosine : shaft.sine, 1).push_back(row);
                if (cosine) own_plane.push_back(coordinates[i]);
                continue;
            }
            switch (rows[i].kind) {
                case MultiBlade::none:
                    block.collective.push_back(row);
                    break;
                case MultiBlade::collective:
                    block.collective.push_back(row), blades = true;
                    break;
                case MultiBlade::cosine:
                    at_harmonic(block.cosine, rows[i].harmonic).push_back(row);
                    break;
                case MultiBlade::sine:
                    at_harmonic(block.sine, rows[i].harmonic).push_back(row);
                    break;
                case MultiBlade::differential:
                    block.differential.push_back(row);
                    break;
            }
            // The collective row stands in the place of blade 1.
            if (rows[i].kind == MultiBlade::none || rows[i].kind == MultiBlade::collective)
                own.push_back(coordinates[i]);
        }
        if (!own.empty()) add_part(lin, model, part, blades, own, std::move(block));
        if (!own_plane.empty()) add_part(lin, model, part, false, own_plane, std::move(shaft));
    }
}

void EnergyFractions::add_part(const Linearisation& lin, const Model& model, const PartAxes& part, bool blades,
                               const std::vector<int>& own, Block block) {
    const Matrix K = lin.elastic(own, own), M = lin.mass(own, own);
    const std::vector<std::string> families = coordinate_families(model, part, own);
    const ComponentModes modes = component_modes(K, M, part.part);
    const bool whirls = !blades && !block.cosine.empty();
    block.first_component = static_cast<int>(components_.size());
    std::map<std::string, int> count;
    for (Eigen::Index i = 0; i < modes.shapes.cols(); ++i) {
        const std::string family = family_of(modes.shapes.col(i), K, families);
        components_.push_back({part.part, family, ++count[family], modes.omega(i) / (2 * pi), blades, whirls});
    }
    block.weights = K * modes.shapes;
    blocks_.push_back(std::move(block));
}

namespace {

// The entries of a shape in some rows, side by side: each is needed for every component.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): memory is filled as far as it is used
class Gathered {
public:
    void set(const std::vector<int>& rows, const ComplexVector& shape) {
        rows_ = &rows;
        shape_ = &shape;
        if (rows.size() > most) return;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const Complex x = shape(rows[i]);
            re_[i] = x.real(), im_[i] = x.imag();
        }
    }
    // sum_i w_i x_i
    template <class Column>
    Complex times(const Column& w) const {
        const auto n = std::ssize(*rows_);
        if (rows_->size() <= most)
            return {w.head(n).dot(Eigen::Map<const Vector>(re_.data(), n)),
                    w.head(n).dot(Eigen::Map<const Vector>(im_.data(), n))};
        Complex sum = 0;
        for (Eigen::Index i = 0; i < n; ++i) sum += w(i) * (*shape_)(entry(*rows_, i));
        return sum;
    }

private:
    static constexpr std::size_t most = 256;
    const std::vector<int>* rows_ = nullptr;
    const ComplexVector* shape_ = nullptr;
    std::array<double, most> re_, im_;
};

}  // namespace

// The pair of one harmonic, by the energy amplitudes of its cosine and its sine.
void EnergyFractions::add_pair(int harmonic, Complex c, Complex s, EnergyFraction& share) {
    const double forward = std::norm(c + Complex(0, 1) * s), backward = std::norm(c - Complex(0, 1) * s);
    const double whirl = forward + backward > 0 ? (forward - backward) / (forward + backward) : 0.0;
    if (harmonic == 1)
        share.cosine = std::norm(c), share.sine = std::norm(s), share.whirl = whirl;
    else
        share.higher.push_back({std::norm(c), std::norm(s), whirl});
}

// Energies of all components of a block, not yet divided by their sum. Shares keep the memory of their pairs.
void EnergyFractions::block_shares(const Block& block, const Mode& mode, std::vector<EnergyFraction>& out) {
    const Eigen::Index count = block.weights.cols();
    const auto share = [&](Eigen::Index i) -> EnergyFraction& { return entry(out, block.first_component + i); };
    Gathered x, y;
    x.set(block.collective, mode.shape);
    y.set(block.differential, mode.shape);
    for (Eigen::Index i = 0; i < count; ++i) {
        EnergyFraction& own = share(i);
        own.component = static_cast<int>(block.first_component + i);
        own.collective = std::norm(x.times(block.weights.col(i)));
        own.differential = std::norm(y.times(block.weights.col(i)));
        own.cosine = own.sine = own.whirl = 0;
        own.higher.clear();
    }
    for (std::size_t n = 0; n < block.cosine.size(); ++n) {
        x.set(block.cosine[n], mode.shape);
        y.set(block.sine[n], mode.shape);
        for (Eigen::Index i = 0; i < count; ++i)
            add_pair(static_cast<int>(n) + 1, x.times(block.weights.col(i)), y.times(block.weights.col(i)), share(i));
    }
}

void EnergyFractions::shares(const Mode& mode, std::vector<EnergyFraction>& out) const {
    out.resize(components_.size());
    double total = 0;
    for (const Block& block : blocks_) {
        block_shares(block, mode, out);
        for (Eigen::Index i = 0; i < block.weights.cols(); ++i) total += entry(out, block.first_component + i).total();
    }
    for (const BladeBlock& block : blade_blocks_)
        for (Eigen::Index i = 0; i < block.weights[0].cols(); ++i) {
            EnergyFraction& own = entry(out, block.first_component + i);
            own = blade_share(block, i, mode, std::move(own.higher));
            total += own.total();
        }
    divide_by(total, out);
}

void EnergyFractions::divide_by(double total, std::vector<EnergyFraction>& shares) {
    const double scale = total > 0 ? 1 / total : 0.0;
    for (EnergyFraction& own : shares) {
        for (double* part : {&own.collective, &own.cosine, &own.sine, &own.differential}) *part *= scale;
        for (WhirlShare& pair : own.higher) pair.cosine *= scale, pair.sine *= scale;
    }
}

std::vector<EnergyFraction> EnergyFractions::shares(const Mode& mode) const {
    std::vector<EnergyFraction> all;
    shares(mode, all);
    return all;
}

std::vector<EnergyFraction> EnergyFractions::shares(std::span<const Mode> harmonics, double rotor_speed) const {
    std::vector<EnergyFraction> all(components_.size());
    double total = 0;
    std::vector<EnergyFraction> one(components_.size());
    for (const Block& block : blocks_) {
        const int first = block.first_component, end = first + static_cast<int>(block.weights.cols());
        for (const Mode& mode : harmonics) {
            block_shares(block, mode, one);
            for (int i = first; i < end; ++i) add(entry(all, i), entry(one, i), mode.eigenvalue.imag() < 0);
        }
        for (int i = first; i < end; ++i) {
            entry(all, i).component = i;
            total += entry(all, i).total();
        }
    }
    for (const BladeBlock& block : blade_blocks_)
        for (Eigen::Index i = 0; i < block.weights[0].cols(); ++i) {
            EnergyFraction& own = entry(all, block.first_component + i);
            own = blade_share(block, i, harmonics, rotor_speed);
            total += own.total();
        }
    divide_by(total, all);
    return all;
}

std::string EnergyFractions::name(int component, RotorPattern pattern, int harmonic) const {
    const Component& c = entry(components_, component);
    const bool only_one = std::count_if(components_.begin(), components_.end(),
                                        [&](const Component& other) { return other.family == c.family; }) == 1;
    std::string name;
    if (!only_one) {
        const char* ordinal = ordinal_name(c.ordinal);
        name = ordinal ? text(ordinal, " ") : text(c.ordinal, "th ");
    }
    name += c.family;
    if (pattern == RotorPattern::single) return text(name, " (blade ", entry(blade_numbers_, harmonic - 1), ")");
    return pattern == RotorPattern::none
               ? name
               : text(name, " (", pattern_name(pattern), harmonic > 1 ? text(", ", harmonic) : "", ")");
}

}  // namespace cardan::solvers
