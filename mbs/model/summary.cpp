#include "mbs/model/summary.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <iomanip>

namespace cardan {

std::vector<PartMass> masses_by_part(const Tree& tree) {
    std::vector<Placement> pose;  // of every body at q = 0
    for (const Tree::Body& body : tree.bodies())
        pose.push_back(body.parent < 0 ? body.in_parent : entry(pose, body.parent) * body.in_parent);
    std::vector<PartMass> parts;
    for (const Tree::Piece& piece : tree.pieces()) {
        auto part = std::find_if(parts.begin(), parts.end(), [&](const PartMass& p) { return p.part == piece.part; });
        if (part == parts.end()) part = parts.insert(parts.end(), {piece.part, 0.0, Vec3::Zero(), false});
        const Vec3 centre = piece.body < 0 ? piece.inertia.com : entry(pose, piece.body) * piece.inertia.com;
        const double mass = part->mass + piece.inertia.mass;
        if (mass > 0) part->centre = (part->first_moment() + piece.inertia.mass * centre) / mass;
        part->mass = mass;
        part->reduced = part->reduced || piece.inertia.reduced;
    }
    return parts;
}

std::string summary(const Tree& tree) {
    std::ostringstream out = text_stream();
    int massless = 0;
    for (const Tree::Body& body : tree.bodies()) massless += body.spec.inertia.is_massless();
    out << "bodies: " << tree.bodies().size() << " (" << massless
        << " of them massless), frames: " << tree.frames().size()
        << "\n\nmass by part                     kg     centre of mass at q = 0, m (x, y, z)\n";
    double total = 0;
    Vec3 moment = Vec3::Zero();
    const auto row = [&](const std::string& name, double mass, const Vec3& centre, bool reduced) {
        out << "  " << std::left << std::setw(24) << name << std::right << std::fixed << std::setprecision(1)
            << std::setw(12) << mass << std::setprecision(4) << std::setw(12) << centre(0) << std::setw(12) << centre(1)
            << std::setw(12) << centre(2) << (reduced ? "  (reduced inertia)" : "") << "\n";
    };
    for (const PartMass& part : masses_by_part(tree)) {
        row(part.part, part.mass, part.centre, part.reduced);
        total += part.mass;
        moment += part.first_moment();
    }
    row("total", total, total > 0 ? Vec3(moment / total) : Vec3::Zero(), false);
    if (!tree.armatures().empty()) {
        out << "\narmatures\n";
        for (const Armature& a : tree.armatures()) {
            out << "  " << std::left << std::setw(24) << a.name << std::right << std::setprecision(4) << std::setw(16)
                << a.inertia << " on";
            for (const auto& [body, factor] : a.spin)
                out << " " << (factor == 1 ? "" : text(factor, " * ")) << "'"
                    << entry(tree.bodies(), body.index).spec.coordinate.name << "'";
            out << "\n";
        }
    }
    if (!tree.added_masses().empty()) out << "\nadded masses\n";
    for (const AddedMass& water : tree.added_masses())
        out << "  " << std::left << std::setw(24) << water.name << std::right << std::setprecision(1) << std::setw(16)
            << water.inertia.bottomRightCorner<3, 3>().trace() / 3 << " kg, mean of three directions, on '"
            << entry(tree.frames(), water.frame.index).name << "'\n";
    out << "\ncoordinates: " << tree.bodies().size() << "\n";
    int index = 0;
    for (const Tree::Body& body : tree.bodies()) {
        const CoordinateInfo& c = body.spec.coordinate;
        out << "  " << std::setw(3) << index++ << "  " << std::left << std::setw(40) << c.name << std::setw(4) << c.unit
            << (c.role == CoordinateRole::prescribed ? " driven" : "") << std::right << "\n";
    }
    return out.str();
}

}  // namespace cardan
