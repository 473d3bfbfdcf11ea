// The first byte says which of the eight files of a model the rest replaces; the others are those of tests/data.
#include "tests/fuzz/fuzz.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/readers/openfast.hpp"

#include <array>

namespace {

constexpr std::array<const char*, 8> files{
    "small.fst",         "small_ElastoDyn.dat", "small_Blade.dat",         "small_Tower.dat",
    "small_BeamDyn.fst", "small_BeamDyn.dat",   "small_BeamDyn_Blade.dat", "small_ServoDyn.dat"};

std::filesystem::path original(const char* file) {
    return std::filesystem::path(CARDAN_SOURCE_DIR "/tests/data/openfast") / file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cardan;
    using namespace cardan::turbines;
    static const bool copied = [] {
        for (const char* file : files) std::filesystem::copy_file(original(file), fuzz::folder() / file);
        return true;
    }();
    if (!copied || size == 0) return 0;
    const std::size_t which = data[0] % files.size();
    fuzz::write(fuzz::folder() / files[which], fuzz::text_of(data + 1, size - 1));
    for (const char* main : {"small.fst", "small_BeamDyn.fst"})
        fuzz::try_it([&] {
            const TurbineFile machine = read_openfast(fuzz::folder() / main);
            (void)assemble(machine.description, {.tower_elements = 1, .blade_elements = 1});
        });
    std::filesystem::copy_file(original(files[which]), fuzz::folder() / files[which],
                               std::filesystem::copy_options::overwrite_existing);
    return 0;
}
