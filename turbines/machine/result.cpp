#include "turbines/machine/result.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"

namespace cardan::turbines {

bool is_result(const std::filesystem::path& path) {
    return lower_case(path.extension().string()) == ".h5";
}

// What HDF5 cannot open, being written or in need of repair, can only be a history.
bool is_history(const std::filesystem::path& result) {
    try {
        return solvers::Hdf5File::open(result).has_attribute("/", "format");
    } catch (const FileError&) {
        return true;
    }
}

std::string input_description(const std::filesystem::path& result) {
    if (is_history(result)) return solvers::read_history_info(result).about.description;
    const solvers::Hdf5File file = solvers::Hdf5File::open(result);
    if (!file.has("input_description"))
        throw FileError(result.string(), "holds no input description: it is no result of this program");
    return file.read_strings("input_description").front();
}

std::string machine_text(const std::string& input_description, const std::string& result) {
    const std::size_t at = input_description.rfind("\ncardan_turbine:");
    if (at == std::string::npos) throw FileError(result, "holds no machine");
    return input_description.substr(at + 1);
}

}  // namespace cardan::turbines
