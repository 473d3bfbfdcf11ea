#include "tests/fuzz/fuzz.hpp"
#include "turbines/tables/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    const std::string_view text = fuzz::text_of(data, size);
    fuzz::try_it([&] {
        const CsvTable table = CsvTable::parse(text, "a.csv");
        for (const std::string& name : table.names())
            for (const double value : table.column(name)) fuzz::require_finite(value);
    });
    return fuzz::try_it([&] { (void)CsvQuantities::parse(text, "a.csv").number("tilt", "deg"); });
}
