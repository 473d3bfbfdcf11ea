#include "programs/shared/run_record.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/version.hpp"
#include "turbines/machine/result.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace cardan::program {

namespace {

constexpr std::string_view head = "made by cardan ";
// Where files are, what is printed, what the machine holds.
constexpr std::array not_kept{"--with",     "--set",    "--out",  "--save",  "--foundation", "--air",
                              "--schedule", "--resume", "--list", "--notes", "--summary"};

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

RunRecord read_run_record(const std::filesystem::path& result) {
    std::istringstream lines = text_reader(turbines::input_description(result));
    std::string first;
    std::getline(lines, first);
    const std::size_t colon = first.find(": cardan ");
    if (!first.starts_with(head) || colon == std::string::npos)
        throw FileError(result.string(), "does not say by which command it was made: it cannot be repeated");
    RunRecord record{first.substr(colon + 9), first.substr(head.size(), colon - head.size()), {}};
    for (std::string line; std::getline(lines, line) && !line.empty();) record.words.push_back(line);
    return record;
}

}  // namespace cardan::program
