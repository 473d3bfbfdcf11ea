#include "turbines/model/detail/beam_options.hpp"

#include "mbs/base/error.hpp"

namespace cardan::turbines {

namespace {

constexpr int max_elements = 1000;

CardanBeamOptions elements_of(const AssemblyOptions& options, int elements) {
    CardanBeamOptions beam;
    beam.elements = elements;
    beam.partition = options.partition;
    beam.delta = options.delta;
    return beam;
}

// Directions in which the sections are rigid have no coordinate.
CardanBeamOptions elements_of(const AssemblyOptions& options, const std::optional<int>& elements, const BeamLine& line,
                              bool extension) {
    CardanBeamOptions beam = elements_of(options, elements.value_or(1));
    if (!line.section) return beam;  // refused where elements are made of it
    const Mat6 compliance = line.section(line.length / 2).compliance;
    beam.torsion = compliance(3, 3) > 0;
    beam.extension = extension && compliance(0, 0) > 0;
    return beam;
}

}  // namespace

void check_elements(const AssemblyOptions& options) {
    const auto check = [](const char* part, const std::optional<int>& elements) {
        if (elements && (*elements < 1 || *elements > max_elements))
            throw InputError(part, "number of elements", *elements, text("1 ... ", max_elements));
    };
    check("tower", options.tower_elements);
    check("blades", options.blade_elements);
}

CardanBeamOptions tower_beam_options(const TowerDescription& tower, const AssemblyOptions& options) {
    CardanBeamOptions beam =
        options.tower_beam ? *options.tower_beam : elements_of(options, options.tower_elements, tower.line, false);
    beam.locked_y |= tower.locked_side_side;
    beam.locked_z |= tower.locked_fore_aft;
    return beam;
}

CardanBeamOptions blade_beam_options(const BladeDescription& blade, const AssemblyOptions& options) {
    CardanBeamOptions beam = options.blade_beam
                                 ? *options.blade_beam
                                 : elements_of(options, options.blade_elements, blade.line, options.extension);
    if (!blade.rigid) return beam;
    beam.hold_all();
    if (!options.blade_beam) beam.partition = Partition::segment_masses;  // the true mass, whatever the taper
    return beam;
}

CardanBeamOptions shaft_beam_options(const AssemblyOptions& options) {
    return elements_of(options, 1);
}

bool seeks_blade_elements(const TurbineDescription& d, const AssemblyOptions& options) {
    if (options.blade_elements || options.blade_beam) return false;
    for (int k = 1; k <= d.blades; ++k)
        if (const BladeDescription* blade = d.blade_at(k); blade != nullptr && !blade->rigid) return true;
    return false;
}

bool seeks_tower_elements(const TurbineDescription& d, const AssemblyOptions& options) {
    return !options.tower_elements && !options.tower_beam && !d.tower.rigid;
}

}  // namespace cardan::turbines
