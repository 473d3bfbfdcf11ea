// Model files with a line missing or a number spoilt: a clear error, or the same machine as before; never another one
// in silence.
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/yaml/windio.hpp"

using namespace cardan;
using namespace cardan::turbines;

namespace {

bool is_number(const std::string& word) {
    return !word.empty() && word.find_first_of("0123456789") != std::string::npos &&
           word.find_first_not_of("0123456789+-.eEdD") == std::string::npos;
}

// Begin and size of the numbers of a line.
std::vector<std::pair<std::size_t, std::size_t>> numbers_in(const std::string& line) {
    constexpr auto separators = " \t,[]{}:";
    std::vector<std::pair<std::size_t, std::size_t>> all;
    for (std::size_t at = line.find_first_not_of(separators); at != std::string::npos;) {
        const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
        if (is_number(line.substr(at, end - at))) all.emplace_back(at, end - at);
        at = line.find_first_not_of(separators, end);
    }
    return all;
}

// All damaged forms of a text.
template <class Try>
void damage(const std::string& original, const Try& attempt) {
    const std::vector<std::string> lines = test::lines_of(original);
    int count = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::vector<std::string> changed = lines;
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(i));
        attempt(test::joined(changed), text("without line ", i + 1, ": ", lines[i]), true);
        for (const auto& [at, size] : numbers_in(lines[i])) {
            const char* bad = ++count % 2 == 0 ? "x1" : "NaN";
            changed = lines;
            changed[i].replace(at, size, bad);
            attempt(test::joined(changed), text("line ", i + 1, ", ", bad, ": ", changed[i]), false);
        }
    }
}

// Reads the damaged files of a model: an Error that names the file, or the same machine.
void check_openfast(const std::string& main, const std::string& damaged) {
    const test::ModelFolder model("openfast");
    const std::string expected = test::state(read_openfast(model / main)), original = test::bytes_of(model / damaged);
    int errors = 0, same = 0;
    damage(original, [&](const std::string& changed, const std::string& what, bool) {
        model.write(damaged, changed);
        try {
            const bool equal = test::state(read_openfast(model / main)) == expected;
            ++same;
            if (equal) return;
            FAIL_CHECK(what << "\nread as another machine without an error");
        } catch (const Error& error) {
            ++errors;
            if (std::string(error.what()).find(".dat") == std::string::npos &&
                std::string(error.what()).find(".fst") == std::string::npos)
                FAIL_CHECK(what << "\nthe error names no file: " << error.what());
        }
    });
    CHECK(errors > 5);
    CHECK(same > 3);
}

}  // namespace

TEST_CASE("model files: damaged OpenFAST files give an error or the same machine", "[property]") {
    SECTION("main file") {
        check_openfast("small.fst", "small.fst");
    }
    SECTION("ElastoDyn") {
        check_openfast("small.fst", "small_ElastoDyn.dat");
    }
    SECTION("blade") {
        check_openfast("small.fst", "small_Blade.dat");
    }
    SECTION("tower") {
        check_openfast("small.fst", "small_Tower.dat");
    }
    SECTION("ServoDyn") {
        check_openfast("small.fst", "small_ServoDyn.dat");
    }
    SECTION("BeamDyn") {
        check_openfast("small_BeamDyn.fst", "small_BeamDyn.dat");
    }
    SECTION("BeamDyn blade") {
        check_openfast("small_BeamDyn.fst", "small_BeamDyn_Blade.dat");
    }
}

TEST_CASE("model files: damaged windIO and own YAML files give an error or a machine", "[property]") {
    const auto check = [](const std::string& original, const auto& read) {
        const std::string expected = read(original);
        int errors = 0;
        damage(original, [&](const std::string& changed, const std::string& what, bool removed) {
            try {
                // Entries of windIO may be missing: the machine is another one then, with a note or without that entry.
                if (read(changed) != expected && !removed) FAIL_CHECK(what << "\nread as another machine");
            } catch (const Error& error) {
                ++errors;
                if (std::string(error.what()).find("machine.yaml:") == std::string::npos)
                    FAIL_CHECK(what << "\nthe error names no file: " << error.what());
            }
        });
        CHECK(errors > 30);
    };
    const auto windio = [](const std::string& text) {
        const TurbineFile file = parse_windio(text, "machine.yaml");
        return file.description.missing.empty() ? test::state(file) : in_words(file.description.missing);
    };
    SECTION("windIO 1") {
        check(test::bytes_of(test::data_file("windio/small_v1.yaml")), windio);
    }
    SECTION("windIO 2") {
        check(test::bytes_of(test::data_file("windio/small_v2.yaml")), windio);
    }
    SECTION("own") {
        TurbineDescription d = read_openfast(test::data_file("openfast/small_BeamDyn.fst")).description;
        d.source = "";
        check(to_yaml(d), [](const std::string& text) {
            TurbineFile read;
            read.description = parse_description(text, "machine.yaml");
            return test::state(read);
        });
    }
}
