/// @file
/// The command line of a program: options, flags and subcommands of CLI11, whose headers take a compiler six seconds
/// and are therefore included by command_line.cpp alone.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cardan::program {

/// A handle of an option or flag; it is good as long as its command line. What it refuses is wrong usage.
class Option {
public:
    explicit Option(CLI::Option& option) : option_(&option) {}

    Option& required();
    Option& one_of(const std::vector<std::string>& allowed);
    Option& range(int min, int max);
    /// Refuses numbers that are out of range: InputError, thrown by CommandLine::parse().
    Option& finite();
    Option& positive();
    Option& not_negative();
    /// Separates the values within one word.
    Option& delimiter(char character);
    /// Lets every use take one word; a list otherwise takes all words up to the next option.
    Option& one_word();
    /// Sets what help calls the value, instead of TEXT, INT or FLOAT.
    Option& type_name(const std::string& name);
    /// Hides a default that stands for something else from help.
    Option& hide_default();
    Option& excludes(const Option& other);
    Option& needs(const Option& other);
    /// Refuses values other than the default where another option, without which this means nothing, is not given. The
    /// default is what results hold that were made without it.
    Option& only_with(const Option& other);

    /// "--name"
    std::string name() const;
    /// Was it given?
    bool given() const;

private:
    CLI::Option* option_;
};

/// Options have --help and --version besides. Targets hold the defaults, which help shows but for what is empty, and
/// must live as long as the command line.
class CommandLine {
public:
    explicit CommandLine(const std::string& description);

    /// @param name  "--name", or "name" for one that is known by its place
    Option add_option(const std::string& name, int& target, const std::string& what);
    Option add_option(const std::string& name, std::optional<int>& target, const std::string& what);
    Option add_option(const std::string& name, double& target, const std::string& what);
    Option add_option(const std::string& name, std::optional<double>& target, const std::string& what);
    Option add_option(const std::string& name, std::string& target, const std::string& what);
    Option add_option(const std::string& name, std::filesystem::path& target, const std::string& what);
    Option add_option(const std::string& name, std::vector<std::string>& target, const std::string& what);
    /// @param name  "--name", or "--name,!--opposite"
    Option add_flag(const std::string& name, bool& target, const std::string& what);
    /// Sets the text behind the options of the help, and of that of subcommands added later.
    void footer(const std::string& text);

    /// One of the subcommands must be given.
    CommandLine add_subcommand(const std::string& name, const std::string& what);
    /// Lets a subcommand fall through: options of the command line may follow it as well.
    void fallthrough();
    /// The name of the subcommand that was given.
    std::string subcommand();

    /// Reads the command line. Names that options and their values had in earlier versions are read as well, and a
    /// note says the new ones.
    /// @return exit code to end with (0 after --help and --version, 2 for wrong usage), -1: go on
    [[nodiscard]] int parse(int argc, char** argv);
    /// Options with what their targets hold now, each as one word: "--rpm=12". Flags that are not set, what is empty
    /// and what is known by its place are left out, and so are the options of subcommands.
    std::vector<std::string> words() const;
    /// Says that two options, read already, do not go together.
    /// @return 2
    [[nodiscard]] int refuse(const std::string& option, const std::string& beside);

private:
    using Words = std::vector<std::string>;

    explicit CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}
    void remember(const std::string& name, std::function<void(Words&)> value);

    std::shared_ptr<CLI::App> app_;                     ///< a subcommand shares its parent's life
    std::vector<std::function<void(Words&)>> writers_;  ///< of words()
};

}  // namespace cardan::program
