#include "turbines/readers/elastodyn.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

namespace cardan::turbines {

namespace {

// The main file of FAST 7 has the entries of ServoDyn as well.
std::vector<KeywordGroup> ignored_by_elastodyn(bool fast7) {
    std::vector<KeywordGroup> all{
        {{"Echo",    "Method",   "DT",        "BldNodes", "TwrNodes",  "SumPrint",  "OutFile",  "TabDelim",
          "OutFmt",  "TStart",   "DecFact",   "NTwGages", "TwrGagNd",  "NBlGages",  "BldGagNd", "OutList*",
          "BldNd_*", "CompAero", "CompNoise", "TMax",     "AbortMode", "ADAMSPrep", "AnalMode", "NumCrctn"},
         "output and numerical settings: without meaning for the machine"},
        {{"ShftGagL", "NcIMU*", "AzimB1Up"}, "places of sensors: without effect on the motion"},
        {{"FurlFile", "Furling"}, "furling is off"},
        {{"Teet*", "Delta3", "UndSling"}, "teetering: this machine has none"},
        {{"YawFrct*", "M_CSmax", "M_FCSmax", "M_MCSmax", "M_CD", "M_FCD", "M_MCD", "sig_v", "sig_v2", "OmgCut"},
         "friction of the yaw bearing: not part of the model"},
        {{"OoPDefl", "IPDefl", "TTDsp*"}, "initial conditions: those of a simulation are given to it here"},
        {{"PreCone*", "TipMass*", "BldFile*", "BlPitch*", "PBrIner*", "BlPIner*", "PitchDOF", "PtfmYDOF"},
         "of blades or joints that the machine does not have"}};
    if (fast7) all.push_back({{"*"}, "control, brakes, electrical drive, air and output: not part of the description"});
    return all;
}

std::string numbered(const char* keyword, int blade) {
    return text(keyword, "(", blade, ")");
}

class Reader {
public:
    Reader(const std::filesystem::path& path, const ElastoDynContext& context)
        : file_(OpenFastFile::read(path)), context_(context) {}

    TurbineFile read() {
        d_.name = file_.machine_name();
        d_.blades = file_.integer("NumBl", 1, 3);
        add_source(file_.name(), file_.text());
        read_gravity();
        read_tower();
        read_yaw();
        read_nacelle();
        read_drive_train();
        read_hub();
        read_teeter();
        read_blades();
        read_dofs();
        note_states();
        for (FileNote& note : file_.notes(ignored_by_elastodyn(is_fast7(file_)))) out_.notes.push_back(std::move(note));
        admit_unusual(out_, file_.name());
        return std::move(out_);
    }

private:
    double angle(std::string_view keyword, double limit = 180) {
        const double value = file_.number(keyword);
        if (std::abs(value) > limit)
            file_.fail(keyword, text(keyword, " = ", value, "; allowed: ", -limit, " ... ", limit, " degrees"));
        return value * units::degree;
    }
    void add_source(const std::string& name, const std::string& content) {
        d_.source += text("# ", name, "\n", content, content.ends_with('\n') ? "" : "\n");
    }
    void keep(ElastoDynBeam& beam, const std::string& name) {
        add_source(name, beam.source);
        for (FileNote& note : beam.notes) out_.notes.push_back(std::move(note));
    }

    void read_gravity() {
        if (!file_.has("Gravity")) return;
        out_.gravity = file_.not_negative("Gravity");
        if (out_.gravity == 0) file_.note("Gravity", "nothing has weight in this model");
    }

    void read_tower() {
        const double top = file_.number("TowerHt");
        if (!is_fast7(file_)) return set_tower(top, file_.number("TowerBsHt"), "TowerBsHt");
        const double rigid = file_.not_negative("TwrRBHt");
        if (rigid > 0) file_.note("TwrRBHt", "the part of the tower that is rigid belongs to the ground here");
        set_tower(top, rigid - draft_of_platform(), "TwrRBHt");
    }

    void set_tower(double top, double base, const char* keyword) {
        if (!(top > base))
            file_.fail("TowerHt", text("TowerHt = ", top, "; allowed: above the tower's foot, ", base, " (", keyword,
                                       "): a tower that hangs is that of a machine under water, which has no "
                                       "description here"));
        if (base != 0) file_.note(keyword, "the origin of the ground axes is the foot of the tower here");
        d_.missing_foundation.where = text(base, " m above the ground or the still water (", keyword, ")");
        out_.tower_base = base;
        const std::filesystem::path path = file_.path("TwrFile");
        ElastoDynBeam tower = file_.follow("TwrFile", [&] { return elastodyn_tower(path, top - base); });
        d_.tower.line = tower.line;
        d_.tower.damping = tower.damping;
        keep(tower, path.string());
    }

    // How far below the ground or the still water the tower begins, m, in FAST 7.
    double draft_of_platform() {
        if (file_.number_or("PtfmModel", 0) == 0) return 0;
        file_.note("PtfmModel", "a platform is not read; see TurbineDescription::platform");
        d_.missing_foundation.name = file_.number("PtfmModel") == 3 ? "floating platform" : "foundation";
        const std::filesystem::path path = file_.path("PtfmFile");
        return file_.follow("PtfmFile", [&] { return OpenFastFile::read(path).number("TwrDraft"); });
    }

    void read_yaw() {
        d_.yaw.translation = rigid_joint;
        out_.yaw_drive = context_.yaw;
        d_.yaw.rotation = file_.flag("YawDOF") ? context_.yaw : rigid_joint;
        if (file_.flag("YawDOF") && context_.yaw.is_rigid())
            file_.left_out("YawDOF",
                           "stiffness and damping of the yaw drive are in the ServoDyn file: rigid without it");
    }

    void read_nacelle() {
        NacelleDescription& n = d_.nacelle;
        n.inertia.mass = file_.not_negative("NacMass");
        n.inertia.com = {file_.number("NacCMxn"), file_.number("NacCMyn"), file_.number("NacCMzn")};
        // Given about the yaw axis, kept about the mass centre.
        const double about_axis = file_.not_negative("NacYIner"),
                     steiner = n.inertia.mass * n.inertia.com.head<2>().squaredNorm();
        if (about_axis < steiner)
            file_.fail("NacYIner", text("NacYIner = ", about_axis, "; allowed: at least ", steiner,
                                        ", mass of the nacelle times its distance from the yaw axis squared"));
        n.inertia.J(2, 2) = about_axis - steiner;
        n.inertia.reduced = true;
        if (const double bearing = file_.not_negative("YawBrMass"); bearing > 0) {
            RigidInertia at_top;
            at_top.mass = bearing;
            n.inertia = n.inertia + at_top;
            file_.note("YawBrMass", "is part of the nacelle here, on the yaw axis at the tower top");
        }
        n.shaft_height = file_.number("Twr2Shft");
        n.tilt = -angle("ShftTilt", 45);
        n.overhang = -file_.number("OverHang");  // to the apex, of two-bladed rotors to the teeter pin
        n.tilt_bearing = rigid_joint;
    }

    void read_drive_train() {
        DriveTrainDescription& t = d_.drive_train;
        t.gear_ratio = file_.positive("GBRatio");
        t.generator_inertia = file_.not_negative("GenIner");
        t.high_speed_shaft = rigid_joint;
        t.main_shaft = {file_.not_negative("DTTorSpr"), file_.not_negative("DTTorDmp")};
        if (file_.flag_or("GBRevers", false)) file_.note("GBRevers", "the generator turns as the rotor does here");
        if (!file_.flag("DrTrDOF"))
            t.main_shaft = rigid_joint;
        else
            file_.positive("DTTorSpr");
        if (!file_.flag("GenDOF")) t.spin = CoordinateRole::prescribed;
        file_.left_out_unless("GBoxEff", 100, "losses of the gearbox: not part of the model");
    }

    void read_hub() {
        d_.hub.radius = file_.not_negative("HubRad");
        RigidInertia& hub = d_.hub.inertia;
        hub.mass = file_.not_negative("HubMass");
        hub.com = {0, 0, file_.number("HubCM")};
        hub.reduced = true;
        if (d_.blades == 2) return read_hub_of_two_blades();
        hub.J(2, 2) = file_.not_negative("HubIner");
        file_.note_unless("HubIner_Teeter", 0, "the rotor does not teeter");
    }

    // The origin is the teeter pin, the apex lies upwind of it. Inertias about the teeter axis are kept about the mass
    // centre; where there is no other, it counts about the shaft as well (ElastoDyn: a cylinder across the shaft).
    void read_hub_of_two_blades() {
        RigidInertia& hub = d_.hub.inertia;
        const bool has_both = file_.has("HubIner_Teeter");
        const char* const about_teeter = has_both ? "HubIner_Teeter" : "HubIner";
        hub.com.z() -= file_.number("UndSling");
        const double steiner = hub.mass * hub.com.z() * hub.com.z(), given = file_.not_negative(about_teeter);
        if (given == 0 && steiner > 0) file_.note(about_teeter, "none is given: that of the hub's mass alone");
        if (given > 0 && given < steiner)
            file_.fail(about_teeter, text(about_teeter, " = ", given, "; allowed: at least ", steiner,
                                          ", mass of the hub times its distance from the teeter axis squared"));
        hub.J(1, 1) = std::max(given - steiner, 0.0) / std::pow(std::cos(angle("Delta3", 80)), 2);
        hub.J(2, 2) = has_both ? file_.not_negative("HubIner") : hub.J(1, 1);
    }

    // Springs and dampers that act from rest on are linear; what acts beyond an angle is not part of the description.
    void read_teeter() {
        if (d_.blades != 2) return;
        TeeterDescription& teeter = d_.hub.teeter.emplace();
        teeter.undersling = file_.number("UndSling");
        teeter.delta3 = angle("Delta3", 80);
        teeter.bearing = rigid_joint;
        if (!file_.flag_or("TeetDOF", false)) return;
        teeter.bearing = free_joint;
        if (file_.integer("TeetMod", 0, 2) == 2)
            file_.left_out("TeetMod", "a user's routine: no spring, no damper here");
        if (file_.integer("TeetMod", 0, 2) != 1) return;
        if (file_.number_or("TeetDmpP", 0) == 0)
            teeter.bearing.damping = file_.not_negative("TeetDmp");
        else
            file_.left_out("TeetDmpP", "a damper that acts beyond an angle: not part of the description");
        const double spring = file_.not_negative("TeetSSSp");
        if (file_.number("TeetSStP") != 0)
            file_.left_out("TeetSStP", "a stop: its spring is not part of the description");
        else if (spring > 0)
            teeter.bearing = {spring, teeter.bearing.damping};
        file_.left_out_unless("TeetCDmp", 0, "friction of the teeter bearing: not part of the model");
        file_.left_out_unless("TeetHSSp", 0, "a stop: its spring is not part of the description");
    }

    void read_blades() {
        const double tip = file_.positive("TipRad");
        if (!(tip > d_.hub.radius))
            file_.fail("TipRad", text("TipRad = ", tip, "; allowed: above HubRad = ", d_.hub.radius));
        d_.blade.cone = angle(numbered("PreCone", 1), 45);
        out_.pitch = angle(numbered("BlPitch", 1));
        out_.pitch_source = text("BlPitch(1) of ", std::filesystem::path(file_.name()).filename().string());
        d_.blade.pitch = context_.pitch;
        d_.blade.pitch_inertia = pitch_inertia(1, context_.pitch, context_.pitch_inertia);
        d_.blade.tip_mass = tip_mass(1);
        const std::string blade_file = numbered("BldFile", 1);
        if (context_.blade) {
            ElastoDynBeam blade = *context_.blade;
            if (file_.has(blade_file)) file_.note(blade_file, "not read: the blades come from BeamDyn");
            note_length(blade, tip - d_.hub.radius);
            set_blade(d_.blade, blade, "BeamDyn");
        } else {
            read_blade_file(d_.blade, blade_file, tip - d_.hub.radius);
        }
        for (int k = 2; k <= d_.blades; ++k) read_other_blade(k, tip - d_.hub.radius);
    }

    void note_length(const ElastoDynBeam& blade, double given) {
        if (std::abs(blade.line.length - given) > 1e-3 * given)
            file_.note("TipRad", text("TipRad - HubRad = ", given, " m; the blade of BeamDyn is ", blade.line.length,
                                      " m along its reference line"));
    }

    // All blades have the same joints: one without a drive beside others with one is driven, and does not move.
    void set_other_blade(BladeDescription& blade, ElastoDynOtherBlade other, double length) {
        note_length(other.beam, length);
        set_blade(blade, other.beam, other.file);
        if (!d_.blade.pitch.is_rigid())
            blade.pitch = other.pitch.is_rigid() ? prescribed_joint : other.pitch;
        else if (!other.pitch.is_rigid())
            out_.notes.push_back({other.file, 0, "UsePitchAct", "True", "rigid: the first blade has no pitch drive"});
    }

    void read_blade_file(BladeDescription& blade, const std::string& keyword, double length) {
        const std::filesystem::path path = file_.path(keyword);
        ElastoDynBeam beam = file_.follow(keyword, [&] { return elastodyn_blade(path, length); });
        set_blade(blade, beam, path.string());
    }

    void set_blade(BladeDescription& blade, ElastoDynBeam& beam, const std::string& name) {
        blade.line = beam.line;
        blade.damping = beam.damping;
        keep(beam, name);
    }

    // A blade of its own where it differs from the first.
    void read_other_blade(int k, double length) {
        const std::string cone = numbered("PreCone", k), pitch = numbered("BlPitch", k), file = numbered("BldFile", k),
                          first = numbered("BldFile", 1);
        BladeDescription own = d_.blade;
        if (file_.has(cone)) own.cone = angle(cone);
        if (file_.has(pitch)) own.pitch_setting = angle(pitch) - out_.pitch;
        own.tip_mass = tip_mass(k);
        const bool other_file =
            !context_.blade && file_.has(file) && file_.has(first) && file_.word(file) != file_.word(first);
        const auto other_beam = context_.individual_blades.find(k);
        const bool has_beam = other_beam != context_.individual_blades.end();
        if (other_file) read_blade_file(own, file, length);
        own.pitch_inertia = has_beam ? pitch_inertia(k, other_beam->second.pitch, other_beam->second.pitch_inertia)
                                     : pitch_inertia(k, context_.pitch, context_.pitch_inertia);
        if (has_beam) set_other_blade(own, other_beam->second, length);
        if (other_file || has_beam || own.cone != d_.blade.cone || own.pitch_setting != 0 ||
            own.tip_mass != d_.blade.tip_mass || own.pitch_inertia != d_.blade.pitch_inertia)
            d_.individual_blades[k] = own;
    }

    // Of the first blade where another one is not given.
    double tip_mass(int k) {
        const std::string keyword = numbered("TipMass", k);
        if (!file_.has(keyword)) return k == 1 ? 0 : d_.blade.tip_mass;
        return file_.not_negative(keyword);
    }

    // Of the bearing, unless BeamDyn gives that of its drive. BeamDyn's sections have inertia about their axis; those
    // of ElastoDyn have none, and BlPIner is that of the whole blade. Of the first blade where another one is not
    // given.
    double pitch_inertia(int k, const JointSupport& drive, double of_drive) {
        const std::string bearing = numbered("PBrIner", k), blade = numbered("BlPIner", k);
        if (context_.blade)
            file_.note_unless(blade, 0, "inertia of the blade about its axis: that of BeamDyn's sections");
        if (!drive.is_rigid()) {
            file_.note_unless(bearing, 0, "the pitch drive of BeamDyn has its own (PitchJ)");
            return of_drive;
        }
        if (k > 1 && !file_.has(bearing) && !file_.has(blade)) return d_.blade.pitch_inertia;
        const auto given = [&](const std::string& keyword) {
            return file_.has(keyword) ? file_.not_negative(keyword) : 0;
        };
        return given(bearing) + (context_.blade ? 0 : given(blade));
    }

    // A beam that bends has all its modes: it can be made rigid where all of its flags are False, but not lose one
    // mode.
    bool bends(std::initializer_list<const char*> keywords, const char* what) {
        std::vector<const char*> off;
        for (const char* keyword : keywords)
            if (!file_.flag_or(keyword, true)) off.push_back(keyword);
        if (off.size() == keywords.size()) return false;
        for (const char* keyword : off) file_.note(keyword, text("one mode cannot be switched off: ", what));
        return true;
    }

    void read_dofs() {
        FileDofs f = dofs_of(d_);
        if (context_.blade) {
            for (const char* keyword : {"FlapDOF1", "FlapDOF2", "EdgeDOF"})
                if (!file_.flag_or(keyword, true)) file_.note(keyword, "of ElastoDyn's blades: BeamDyn's bend");
        } else {
            f.blades = bends({"FlapDOF1", "FlapDOF2", "EdgeDOF"}, "the blades are beams and bend with all theirs");
        }
        f.tower_fore_aft = bends({"TwFADOF1", "TwFADOF2"}, "the tower is a beam and bends with all its fore-aft modes");
        f.tower_side_side =
            bends({"TwSSDOF1", "TwSSDOF2"}, "the tower is a beam and bends with all its side-side modes");
        set_dofs(f, d_);
        for (const char* keyword : {"PtfmSgDOF", "PtfmSwDOF", "PtfmHvDOF", "PtfmRDOF", "PtfmPDOF", "PtfmYDOF"})
            if (file_.flag_or(keyword, false)) {
                file_.left_out(keyword, "the tower is clamped at its foot; see TurbineDescription::platform");
                d_.missing_foundation.name = "floating platform";
            }
        if (file_.flag_or("PitchDOF", false)) file_.left_out("PitchDOF", "the pitch bearings are rigid");
        if (file_.flag_or("Furling", false)) file_.left_out("Furling", "furling is not part of the model");
    }

    void note_states() {
        const double speed = file_.not_negative("RotSpeed") * units::rpm;
        out_.rotor_speed = d_.rotor_speed = speed;
        out_.rotor_speed_source = text("RotSpeed of ", std::filesystem::path(file_.name()).filename().string());
        ModelRun& run = out_.run.emplace();
        run.rotor_speed = speed;
        if (!out_.pitch_source.empty()) run.pitch = out_.pitch;
        if (file_.has("Azimuth")) run.azimuth = angle("Azimuth", 360);
        if (file_.has("NacYaw")) run.yaw = angle("NacYaw", 180);
        file_.note_unless("NacYaw", 0, "of the start of a run in time; else the nacelle points into the wind here");
        for (const char* keyword : {"OoPDefl", "IPDefl", "TTDspFA", "TTDspSS", "PtfmSurge", "PtfmSway", "PtfmHeave",
                                    "PtfmRoll", "PtfmPitch", "PtfmYaw", "TeetDefl"})
            file_.note_unless(keyword, 0, "initial condition: those of a simulation are given to it here");
        for (const char* keyword : {"PtfmMass", "PtfmRIner", "PtfmPIner", "PtfmYIner", "PtfmXYIner", "PtfmYZIner",
                                    "PtfmXZIner", "PtfmCMxt", "PtfmCMyt", "PtfmCMzt", "PtfmRefzt"})
            file_.left_out_unless(keyword, 0, "a platform is not read; see TurbineDescription::platform");
    }

    OpenFastFile file_;
    const ElastoDynContext& context_;
    TurbineFile out_;
    TurbineDescription& d_ = out_.description;
};

}  // namespace

bool is_fast7(const OpenFastFile& file) {
    return file.has("NumBl") && file.has("TwrRBHt") && !file.has("TowerBsHt");
}

TurbineFile read_elastodyn(const std::filesystem::path& path, const ElastoDynContext& context) {
    return Reader(path, context).read();
}

}  // namespace cardan::turbines
