#include "turbines/readers/detail/inflow_wind_boxes.hpp"

#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/detail/openfast_words.hpp"
#include "turbines/readers/hawc2_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

#include <limits>

namespace cardan::turbines {

namespace {

// The first of several spellings that the file has, else the first one of all, for the error that it is missing.
const char* spelling(const OpenFastFile& file, std::initializer_list<const char*> all) {
    for (const char* const one : all)
        if (file.has(one)) return one;
    return *all.begin();
}

// A number of the part on HAWC's files. Older files have the keyword of other parts, which stand before this one.
double number_of_hawc(OpenFastFile& file, std::initializer_list<const char*> own, const char* shared) {
    const char* const keyword = spelling(file, own);
    if (file.has(keyword) || file.count(shared) < 2) return file.number(keyword);
    return file.number_of(shared, file.count(shared) - 1);
}

WindBoxFile turbsim_of(OpenFastFile& file) {
    const char* const own = spelling(file, {"FileName_BTS", "FilenameT3"});
    // Older files: one for uniform wind before this one.
    const bool shared = !file.has(own) && file.has("Filename");
    const char* const keyword = shared ? "Filename" : own;
    const std::filesystem::path path = shared ? file.path_of(keyword, file.count(keyword) - 1) : file.path(keyword);
    return file.follow(keyword, [&] { return read_turbsim_box(path); });
}

WindBoxFile bladed_of(OpenFastFile& file) {
    constexpr auto keyword = "FilenameRoot", ending = ".wnd";
    std::string name = file.word(keyword);
    if (!lower_case(std::string_view(name)).ends_with(ending)) name += ending;
    const std::filesystem::path path = file_beside(file.name(), name);
    const TowerFile tower = file.flag_or("TowerFile", false) ? TowerFile::beside : TowerFile::none;
    return file.follow(keyword, [&] { return read_bladed_box(path, tower); });
}

WindBoxFile native_bladed_of(OpenFastFile& file) {
    constexpr auto keyword = "FilenameRoot";
    const std::filesystem::path path = file.path(keyword);
    WindBoxFile out = file.follow(keyword, [&] { return read_native_bladed_box(path); });
    for (const char* const other : {"PropagationDir", "VFlowAng"})
        if (file.has(other)) file.note_unless(other, 0, text("WDIR and FLINC of ", path.string(), " are in its place"));
    return out;
}

SteadyWind hawc_mean(OpenFastFile& file) {
    SteadyWind out;
    out.speed = file.positive("URef");
    out.reference_height = number_of_hawc(file, {"RefHt_Hawc", "RefHtT5"}, "RefHt");
    constexpr int logarithmic = 1, power = 2;
    const int kind = file.integer("WindProfile", 0, power);
    if (kind == logarithmic) {
        out.shear = Shear::logarithmic;
        out.roughness = file.positive("Z0");
    } else if (kind == power) {
        out.shear = Shear::power;
        out.exponent = number_of_hawc(file, {"PLExp_Hawc", "PLExpT5"}, "PLExp");
    }
    return file.checked("URef", [&] {
        out.check();
        return out;
    });
}

WindBoxFile hawc_of(OpenFastFile& file, PlaneOrder order) {
    constexpr int most = std::numeric_limits<int>::max();
    constexpr auto first = "FileName_u";
    Hawc2Box box;
    box.files = {file.path(first), file.path("FileName_v"), file.path("FileName_w")};
    box.planes = file.integer("nx", 2, most);
    box.columns = file.integer("ny", 2, most);
    box.rows = file.integer("nz", 2, most);
    box.plane_spacing = file.positive("dx");
    box.column_spacing = file.positive("dy");
    box.row_spacing = file.positive("dz");
    box.order = order;
    box.scaling = static_cast<BoxScaling>(file.integer("ScaleMethod", 0, 2));
    if (box.scaling == BoxScaling::factors) box.factors = {file.number("SFx"), file.number("SFy"), file.number("SFz")};
    if (box.scaling == BoxScaling::deviations)
        box.deviations = {file.not_negative("SigmaFx"), file.not_negative("SigmaFy"), file.not_negative("SigmaFz")};
    box.mean = hawc_mean(file);
    box.start = file.number_or("XOffset", 0);
    return file.follow(first, [&] { return file.checked("ScaleMethod", [&] { return read_hawc2_box(box); }); });
}

}  // namespace

WindBoxFile inflow_wind_box(OpenFastFile& file, InflowWindType type, PlaneOrder order) {
    if (file.flag_or("VelInterpCubic", false))
        file.left_out("VelInterpCubic", "between the planes of a box the wind is linear");
    switch (type) {
        case InflowWindType::turbsim:
            return turbsim_of(file);
        case InflowWindType::bladed:
            return bladed_of(file);
        case InflowWindType::native_bladed:
            return native_bladed_of(file);
        default:
            return hawc_of(file, order);
    }
}

}  // namespace cardan::turbines
