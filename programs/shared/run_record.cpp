#include "programs/shared/run_record.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/version.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace cardan::program {

namespace {

constexpr std::string_view head = "made by cardan ";
constexpr std::string_view machine_key = "\ncardan_turbine:";
// Where files are, what is printed, what the machine holds.
constexpr std::array not_kept{"--with",   "--set",  "--out",   "--save",   "--foundation",
                              "--resume", "--list", "--notes", "--summary"};

std::string name_of(const std::string& word) {
    return word.substr(0, word.find('='));
}

}  // namespace

std::string to_text(const RunRecord& record) {
    std::string lines = text(head, version(), ": cardan ", record.command, "\n");
    for (const std::string& word : record.words)
        if (std::ranges::find(not_kept, name_of(word)) == not_kept.end()) lines += word + "\n";
    return lines + "\n";
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

RunRecord read_run_record(const std::filesystem::path& result) {
    std::istringstream lines = text_reader(input_description(result));
    std::string first;
    std::getline(lines, first);
    const std::size_t colon = first.find(": cardan ");
    if (!first.starts_with(head) || colon == std::string::npos)
        throw FileError(result.string(), "does not say by which command it was made: it cannot be repeated");
    RunRecord record{first.substr(colon + 9), first.substr(head.size(), colon - head.size()), {}};
    for (std::string line; std::getline(lines, line) && !line.empty();) record.words.push_back(line);
    return record;
}

std::string machine_text(const std::filesystem::path& result) {
    const std::string all = input_description(result);
    const std::size_t at = all.rfind(machine_key);
    if (at == std::string::npos) throw FileError(result.string(), "holds no machine");
    return all.substr(at + 1);
}

bool is_result(const std::filesystem::path& path) {
    return lower_case(path.extension().string()) == ".h5";
}

}  // namespace cardan::program
