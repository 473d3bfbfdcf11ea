// A result once more, from what its file holds: the machine, the command and its options.
#include "mbs/base/error.hpp"
#include "mbs/base/version.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/shared/machine_file.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/run_record.hpp"
#include "solvers/hdf5/history.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"

#include <algorithm>
#include <string_view>

namespace cardan::program {

namespace {

struct RepeatArguments {
    std::string file, out;
    bool show = false;
};

void declare(CommandLine& app, RepeatArguments& a) {
    app.add_option("FILE", a.file, "result (.h5)").required();
    app.add_option("--out", a.out, "prefix of the files (default: name of the file and _repeated)");
    app.add_flag("--show", a.show, "only print the command");
}

// Of a history that went on, to where it got.
void set_duration(std::vector<std::string>& words, const std::string& file) {
    const auto duration =
        std::ranges::find_if(words, [](const std::string& w) { return w.starts_with("--duration="); });
    if (duration != words.end()) *duration = "--duration=" + digits(solvers::read_history_info(file).last_time);
}

// A wind over time, from the file that holds it as it was read.
void set_wind(std::vector<std::string>& words, const std::string& file) {
    constexpr std::string_view option = "--wind=";
    const auto wind = std::ranges::find_if(words, [&](const std::string& w) { return w.starts_with(option); });
    if (wind == words.end() || read_number(wind->substr(option.size())).good()) return;
    if (turbines::wind_of(turbines::input_description(file), file)) *wind = text(option, file);
}

int run(RepeatArguments& a, const CommandLine& /*command*/) {
    RunRecord record = read_run_record(a.file);
    set_duration(record.words, a.file);
    set_wind(record.words, a.file);
    if (a.out.empty()) a.out = std::filesystem::path(a.file).stem().string() + "_repeated";
    std::vector<std::string> words{"cardan " + record.command, a.file};
    words.insert(words.end(), record.words.begin(), record.words.end());
    words.push_back("--out=" + a.out);
    for (const std::string& word : words) std::cout << (&word == words.data() ? "" : " ") << word;
    std::cout << "\n" << std::flush;
    if (a.show) return 0;
    if (record.version != version())
        std::cerr << "note: " << a.file << " was made by version " << record.version << ", this is " << version()
                  << "\n";
    int (*const command)(int, char**) = command_of(record.command.c_str());
    if (command == nullptr) throw InputError(a.file, "command", record.command, "one of this version");
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    return command(static_cast<int>(words.size()), argv.data());
}

}  // namespace

int repeat_command(int argc, char** argv) {
    return run_command<RepeatArguments>(
        "cardan repeat",
        "Makes a result once more from what its file holds: the machine, the command and "
        "its options.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
