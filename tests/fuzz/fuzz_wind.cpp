// The first byte says what the rest is: InflowWind's main file, its file of winds over time, or our own tables of wind
// and of operation.
#include "tests/fuzz/fuzz.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/readers/inflow_wind.hpp"

namespace {

using namespace cardan;
using namespace cardan::turbines;

constexpr const char* uniform =
    "title\ntitle\n---\n2 WindType - kind\n30 PropagationDir - deg\n2 VFlowAng - deg\n90 RefHt_Uni - m\n60 RefLength - "
    "m\n\"b.wnd\" Filename_Uni - name\n";

// All of a wind can be asked for everywhere and gives numbers.
void look_at(const Wind& wind) {
    const Wind over = wind.over(0);
    for (const double time : {-1.0, 0.0, 0.5, 1e3})
        for (const double height : {0.0, 10.0, 100.0}) fuzz::require_finite(over.at(time).at({0, -20, height}).norm());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view rest = fuzz::text_of(data + 1, size - 1);
    const auto main = fuzz::folder() / "a.dat", table = fuzz::folder() / "b.wnd";
    switch (data[0] % 4) {
        case 0:
            fuzz::write(main, rest);
            fuzz::write(table, "0 8 0 0 0 0.2 0 0\n9 12 0 0 0 0.2 0 0\n");
            return fuzz::try_it([&] { look_at(read_inflow_wind(main).wind); });
        case 1:
            fuzz::write(main, uniform);
            fuzz::write(table, rest);
            return fuzz::try_it([&] { look_at(read_inflow_wind(main).wind); });
        case 2:
            fuzz::write(table, rest);
            return fuzz::try_it([&] { look_at(read_wind_table(table, {.speed = 8})); });
        default:
            fuzz::write(table, rest);
            return fuzz::try_it([&] {
                for (const Operation& one : read_schedule(table))
                    fuzz::require_finite(one.wind + one.rotor_speed + one.pitch);
            });
    }
}
