// The first byte says which file the rest is, beside good ones: of TurbSim; of Bladed's kind, its summary, its points
// of the tower; of Bladed itself, the text with it; of HAWC2, u or all three with sizes before them.
#include "tests/fuzz/fuzz.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/hawc2_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

#include <cstring>

namespace {

using namespace cardan;
using namespace cardan::turbines;

std::filesystem::path copied(const char* name) {
    const auto from = std::filesystem::path(CARDAN_SOURCE_DIR) / "tests/data/wind" / name, to = fuzz::folder() / name;
    std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing);
    return to;
}

// A box has a wind everywhere, if it is held outside.
void look_at(const WindBoxFile& file) {
    const WindBox box = file.box->with_outside(OutsideBox::hold);
    for (const double time : {-1.0, 0.0, 0.7, 1e3})
        for (const double height : {-1.0, 0.1, 30.0, 75.0, 1e4}) {
            WindBox::Sample is;
            try {
                is = box.with_gradient({1, -20, height}, time);
            } catch (const InputError&) {  // more planes away than can be counted
                continue;
            }
            fuzz::require_finite(is.velocity.squaredNorm());
        }
    const BoxGrid& grid = box.grid();
    fuzz::require_finite(box.at_point(grid.steps - 1, grid.rows - 1, grid.columns - 1).squaredNorm());
    fuzz::require_finite(box.statistics(0, 0).deviation.squaredNorm());
}

Hawc2Box hawc2_box(int planes, int rows, int columns) {
    Hawc2Box box;
    box.files = {fuzz::folder() / "hawc_u.bin", fuzz::folder() / "hawc_v.bin", fuzz::folder() / "hawc_w.bin"};
    box.planes = planes;
    box.rows = rows;
    box.columns = columns;
    box.plane_spacing = 5;
    box.row_spacing = 20;
    box.column_spacing = 15;
    box.mean.speed = 10;
    box.mean.reference_height = 70;
    box.scaling = BoxScaling::deviations;
    box.deviations = {1, 1, 1};
    return box;
}

int replace(const char* name, std::string_view bytes, WindBoxFile (*read)()) {
    fuzz::write(fuzz::folder() / name, bytes);
    const int out = fuzz::try_it([&] { look_at(read()); });
    if (std::filesystem::exists(std::filesystem::path(CARDAN_SOURCE_DIR) / "tests/data/wind" / name)) copied(name);
    return out;
}

// Planes, rows, columns, the order of the planes; then as many numbers for each component.
int three_files(const std::uint8_t* data, std::size_t size) {
    if (size < 4) return 0;
    Hawc2Box box = hawc2_box(data[0], data[1], data[2]);
    box.order = data[3] % 2 == 0 ? PlaneOrder::first_first : PlaneOrder::last_first;
    box.scaling = static_cast<BoxScaling>(data[3] / 2 % 3);
    const std::size_t each = (size - 4) / 3;
    for (std::size_t c = 0; c < 3; ++c) fuzz::write(box.files[c], fuzz::text_of(data + 4 + c * each, each));
    return fuzz::try_it([&] { look_at(read_hawc2_box(box)); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool there = [] {
        for (const char* name :
             {"nrel.wnd", "nrel.sum", "native.wnd", "native.ipt", "hawc_u.bin", "hawc_v.bin", "hawc_w.bin"})
            copied(name);
        return true;
    }();
    if (!there || size == 0) return 0;
    const std::string_view rest = fuzz::text_of(data + 1, size - 1);
    switch (data[0] % 8) {
        case 0:
            return replace("a.bts", rest, [] { return read_turbsim_box(fuzz::folder() / "a.bts"); });
        case 1:
            return replace("nrel.wnd", rest, [] { return read_bladed_box(fuzz::folder() / "nrel.wnd"); });
        case 2:
            return replace("nrel.sum", rest, [] { return read_bladed_box(fuzz::folder() / "nrel.wnd"); });
        case 3:
            return replace("nrel.twr", rest,
                           [] { return read_bladed_box(fuzz::folder() / "nrel.wnd", TowerFile::beside); });
        case 4:
            return replace("native.wnd", rest, [] { return read_native_bladed_box(fuzz::folder() / "native.ipt"); });
        case 5:
            return replace("native.ipt", rest, [] { return read_native_bladed_box(fuzz::folder() / "native.ipt"); });
        case 6:
            return replace("hawc_u.bin", rest, [] {
                for (const char* name : {"hawc_v.bin", "hawc_w.bin"}) copied(name);
                return read_hawc2_box(hawc2_box(16, 4, 5));
            });
        default:
            return three_files(data + 1, size - 1);
    }
}
