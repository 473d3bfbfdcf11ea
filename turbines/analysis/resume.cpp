#include "turbines/analysis/resume.hpp"

#include "mbs/base/error.hpp"
#include "solvers/hdf5/history.hpp"
#include "turbines/model/description_text.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

// Of a description what makes a run: without the command, and without what its machine was read from and why it has no
// air, where files are named that may be called from elsewhere.
std::string what_is_run(std::string description) {
    const auto erase = [&](std::size_t from, std::size_t to) {
        if (from < to && to != std::string::npos) description.erase(from, to - from);
    };
    if (description.starts_with("made by ")) erase(0, description.find("\n\n") + 2);
    erase(description.find(source_of_machine), description.rfind(computed_machine));
    // A wind box is the same wherever its files lie: its checksum is compared.
    constexpr std::string_view wind_file = "wind_file: ";
    for (std::size_t at = description.find(wind_file); at != std::string::npos; at = description.find(wind_file, at))
        erase(at, description.find('\n', at));
    const std::size_t reason = description.find("\nno_air: ");
    if (reason != std::string::npos) erase(reason, description.find('\n', reason + 1));
    return description;
}

// The first parts in which two texts differ: entries of a line, separated by ", ".
struct Difference {
    std::string first, second;
};
Difference difference(const std::string& a, const std::string& b) {
    const auto part = [](const std::string& all, std::size_t& at) -> std::string {
        at = std::min(all.find_first_not_of(", \n", at), all.size());
        if (at == all.size()) return "nothing more";
        const std::size_t from = std::exchange(at, std::min({all.find('\n', at), all.find(", ", at), all.size()}));
        return all.substr(from, at - from);
    };
    for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
        Difference found{part(a, i), part(b, k)};
        if (found.first != found.second) return found;
    }
    return {};
}

}  // namespace

std::optional<solvers::Checkpoint> resumed_checkpoint(const std::filesystem::path& file,
                                                      const std::string& description) {
    solvers::HistoryInfo info = solvers::read_history_info(file);
    if (!info.checkpoint && info.rows > 0)
        throw InputError("RecordSettings::resume", file.string(), "without a checkpoint", "a run that was broken off");
    const std::string made = what_is_run(info.about.description), wanted = what_is_run(description);
    if (made == wanted) return std::move(info.checkpoint);
    const Difference differs = difference(made, wanted);
    throw InputError("RecordSettings::resume", text("run of ", file.string()), differs.first,
                     text("that of this run: ", differs.second));
}

}  // namespace cardan::turbines
