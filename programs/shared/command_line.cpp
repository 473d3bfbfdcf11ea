#include "programs/shared/command_line.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "mbs/base/version.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <iostream>

namespace cardan::program {

namespace {

// @param allowed  of the number; beside it: in words
template <class Allowed>
void require(CLI::Option& option, const Allowed& allowed, const char* words) {
    option.check(CLI::Validator(
        [&option, allowed, words](const std::string& given) {
            const ReadNumber read = read_number(given);
            if (read.fault == ReadNumber::no_number) return std::string();  // which CLI11 says
            if (!read.good() || !allowed(read.value)) throw InputError(option.get_name(), "value", given, words);
            return std::string();
        },
        ""));
}

}  // namespace

Option& Option::required() {
    option_->required();
    return *this;
}

Option& Option::one_of(const std::vector<std::string>& allowed) {
    option_->check(CLI::IsMember(allowed));
    return *this;
}

Option& Option::range(int min, int max) {
    option_->check(CLI::Range(min, max));
    return *this;
}

Option& Option::finite() {
    require(
        *option_, [](double) { return true; }, "finite");
    return *this;
}

Option& Option::positive() {
    require(
        *option_, [](double value) { return value > 0; }, "finite and > 0");
    return *this;
}

Option& Option::not_negative() {
    require(
        *option_, [](double value) { return value >= 0; }, "finite and >= 0");
    return *this;
}

Option& Option::delimiter(char character) {
    option_->delimiter(character);
    return *this;
}

Option& Option::one_word() {
    option_->allow_extra_args(false);
    return *this;
}

Option& Option::type_name(const std::string& name) {
    option_->type_name(name);
    return *this;
}

Option& Option::hide_default() {
    option_->default_str("");
    return *this;
}

Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}

Option& Option::needs(const Option& other) {
    option_->needs(other.option_);
    return *this;
}

Option& Option::only_with(const Option& other) {
    option_->check(CLI::Validator(
        [own = option_, wanted = other.option_](const std::string& value) {
            const bool idle = wanted->count() > 0 || value == own->get_default_str();
            return idle ? std::string() : text("only with ", wanted->get_name());
        },
        ""));
    return *this;
}

std::string Option::name() const {
    return option_->get_name();
}

bool Option::given() const {
    return option_->count() > 0;
}

CommandLine::CommandLine(const std::string& description) : app_(std::make_shared<CLI::App>(description)) {}

void CommandLine::remember(const std::string& name, std::function<void(Words&)> value) {
    if (name.starts_with("--")) writers_.push_back(std::move(value));
}

Option CommandLine::add_option(const std::string& name, int& target, const std::string& what) {
    remember(name, [name, &target](Words& all) { all.push_back(name + "=" + text(target)); });
    return Option(*app_->add_option(name, target, what)->capture_default_str());
}

Option CommandLine::add_option(const std::string& name, double& target, const std::string& what) {
    remember(name, [name, &target](Words& all) { all.push_back(name + "=" + digits(target)); });
    return Option(*app_->add_option(name, target, what)->capture_default_str());
}

Option CommandLine::add_option(const std::string& name, std::optional<int>& target, const std::string& what) {
    remember(name, [name, &target](Words& all) {
        if (target) all.push_back(text(name, "=", *target));
    });
    return Option(*app_->add_option(name, target, what));
}

Option CommandLine::add_option(const std::string& name, std::optional<double>& target, const std::string& what) {
    remember(name, [name, &target](Words& all) {
        if (target) all.push_back(name + "=" + digits(*target));
    });
    return Option(*app_->add_option(name, target, what));
}

Option CommandLine::add_option(const std::string& name, std::string& target, const std::string& what) {
    remember(name, [name, &target](Words& all) {
        if (!target.empty()) all.push_back(name + "=" + target);
    });
    return Option(*app_->add_option(name, target, what)->capture_default_str());
}

Option CommandLine::add_option(const std::string& name, std::filesystem::path& target, const std::string& what) {
    remember(name, [name, &target](Words& all) {
        if (!target.empty()) all.push_back(name + "=" + target.string());
    });
    return Option(*app_->add_option(name, target, what)->capture_default_str());
}

Option CommandLine::add_option(const std::string& name, std::vector<std::string>& target, const std::string& what) {
    remember(name, [name, &target](Words& all) {
        for (const std::string& word : target) all.push_back(std::string(name).append("=").append(word));
    });
    CLI::Option* option = app_->add_option(name, target, what);
    if (!target.empty()) option->capture_default_str();
    return Option(*option);
}

Option CommandLine::add_flag(const std::string& name, bool& target, const std::string& what) {
    const std::size_t comma = name.find(",!");
    const std::string set = name.substr(0, comma), unset = comma == std::string::npos ? "" : name.substr(comma + 2);
    remember(name, [set, unset, &target](Words& all) {
        if (const std::string& word = target ? set : unset; !word.empty()) all.push_back(word);
    });
    return Option(*app_->add_flag(name, target, what));
}

std::vector<std::string> CommandLine::words() const {
    Words all;
    for (const auto& write : writers_) write(all);
    return all;
}

void CommandLine::footer(const std::string& text) {
    app_->footer(text);
}

CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& what) {
    app_->require_subcommand(1);
    return CommandLine(std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, what)));
}

void CommandLine::fallthrough() {
    app_->fallthrough();
}

std::string CommandLine::subcommand() {
    return app_->get_subcommands().front()->get_name();
}

namespace {

// A variable of the shell that is not set, as a rule: CLI11 takes the default for it.
void refuse_empty_words(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        const bool assigned = word.starts_with("--") && word.ends_with('=');
        if (word.empty() || assigned)
            throw CLI::ValidationError(assigned ? argv[i] : argv[i - 1], "followed by an empty word");
    }
}

struct RenamedOption {
    std::string_view before, now;
};
constexpr std::array renamed_options{RenamedOption{"--least-rpm", "--min-rpm"},
                                     RenamedOption{"--steady-profiles", "--airfoils=steady"},
                                     RenamedOption{"--steady-airfoils", "--airfoils=steady"}};
struct RenamedValue {
    std::string_view option, before, now;
};
constexpr std::array renamed_values{RenamedValue{"--wake", "quasi-steady", "equilibrium"},
                                    RenamedValue{"--wake", "dynamic", "oye"}};

// The value of an option, behind it or in the word after it.
void rename_value(std::string& option, std::string* next) {
    for (const auto& [name, before, now] : renamed_values) {
        const bool own = option == text(name, "=", before), behind = option == name && next && *next == before;
        if (!own && !behind) continue;
        std::cerr << "note: " << name << " " << before << " is " << now << " now\n";
        (own ? option : *next) = own ? text(name, "=", now) : std::string(now);
        return;
    }
}

// The words with the options' names of today. Results hold the command lines of earlier versions, for `cardan repeat`.
std::vector<std::string> with_present_names(int argc, char** argv) {
    std::vector<std::string> words(argv, argv + argc);
    for (std::string& word : words) {
        const std::size_t end = std::min(word.find('='), word.size());
        const auto found =
            std::ranges::find(renamed_options, std::string_view(word).substr(0, end), &RenamedOption::before);
        if (found == renamed_options.end()) continue;
        std::cerr << "note: " << found->before << " is " << found->now << " now\n";
        word.replace(0, end, found->now);
    }
    for (std::size_t i = 0; i < words.size(); ++i)
        rename_value(words[i], i + 1 < words.size() ? &words[i + 1] : nullptr);
    return words;
}

}  // namespace

int CommandLine::parse(int argc, char** argv) {
    app_->set_version_flag("--version", std::string(version()));
    const std::vector<std::string> words = with_present_names(argc, argv);
    std::vector<const char*> pointers;
    pointers.reserve(words.size());
    for (const std::string& word : words) pointers.push_back(word.c_str());
    try {
        refuse_empty_words(argc, argv);
        app_->parse(argc, pointers.data());
    } catch (const CLI::ParseError& error) {
        return app_->exit(error) == 0 ? 0 : 2;
    }
    return -1;
}

int CommandLine::refuse(const std::string& option, const std::string& beside) {
    app_->exit(CLI::ExcludesError(option, beside));
    return 2;
}

}  // namespace cardan::program
