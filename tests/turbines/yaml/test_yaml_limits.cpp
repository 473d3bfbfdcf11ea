// YAML that would cost the parser all memory, all time or the stack is refused, with file, line and limit.
#include "tests/support/allocation_guard.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/yaml/detail/node.hpp"
#include "turbines/yaml/windio.hpp"

#include <sys/resource.h>
#include <sys/wait.h>

using namespace cardan;
using namespace cardan::turbines;
using cardan::testing::AllocationGuard;
using Catch::Matchers::Contains;
using test::message_of;

namespace {

std::string message_of_parsing(const std::string& yaml) {
    return message_of([&] { (void)YamlNode::parse(yaml, "m.yaml"); });
}

std::string repeated(const std::string& part, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += part;
    return all;
}

// The address sanitizer gives back late what is freed: it keeps up to 256 MiB.
rlim_t kept_by_allocator() {
    return AllocationGuard::works() ? 0 : rlim_t{256} << 20;
}

// What the action says in a process of its own, which is killed after ten seconds of work and never takes more memory
// than it had, plus `room`.
template <class Action>
std::string confined(rlim_t room, Action action) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
        std::ifstream pages("/proc/self/statm");
        rlim_t used = 0;
        pages >> used;
        const rlim_t most = used * static_cast<rlim_t>(::getpagesize()) + room + kept_by_allocator();
        const rlimit memory{most, most}, time{10, 10};
        ::setrlimit(RLIMIT_AS, &memory);
        ::setrlimit(RLIMIT_CPU, &time);
        std::string said;
        try {
            said = message_of(action);
        } catch (const std::exception& error) {
            said = error.what();
        }
        said.resize(std::min<std::size_t>(said.size(), 4000));
        const ssize_t written = ::write(ends[1], said.data(), said.size());
        ::_exit(written >= 0 ? 0 : 1);
    }
    ::close(ends[1]);
    std::string said;
    std::array<char, 4096> piece{};
    for (ssize_t n = 0; (n = ::read(ends[0], piece.data(), piece.size())) > 0;)
        said.append(piece.data(), static_cast<std::size_t>(n));
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? text("killed by signal ", WTERMSIG(status)) : said;
}

}  // namespace

TEST_CASE("yaml limits: what is not text never reaches the parser", "[property]") {
    // The parser takes the first for UTF-32 and its characters for lengths: it asks for memory without end.
    constexpr rlim_t room = rlim_t{256} << 20;
    const std::string utf32 = std::string(",\0\0\0\xDA", 5) + "x";
    CHECK_THAT(confined(room, [&] { (void)YamlNode::parse(utf32, "m.yaml"); }),
               Contains("m.yaml:1:2: is no text: the character NUL"));
    CHECK_THAT(confined(room, [&] { (void)read_windio("/dev/zero"); }), Contains("is longer than 64 MiB"));
    CHECK_THAT(message_of_parsing("a: 1\nb: \xFF\xFE\n"), Contains("m.yaml:2:4: is not UTF-8: byte 0xFF"));
    CHECK_THAT(message_of_parsing("a: 1\nb: \x04 c\n"), Contains("m.yaml:2: is not YAML: the control character 4"));
    CHECK_THAT(message_of_parsing("a: \x7F\n"), Contains("control character 127"));
    CHECK(YamlNode::parse("a: \"\\x04\"\r\n", "m.yaml")["a"].word() == "\x04");
}

TEST_CASE("yaml limits: depth, number of nodes, lengths of keys, lines and texts", "[property]") {
    CHECK_THAT(message_of_parsing("a:\n  " + repeated("[", 100'000)),
               Contains("m.yaml:2:") && Contains("nested deeper than 60"));
    CHECK_THAT(message_of_parsing("a:\n" + repeated("[", 100'000)), Contains("m.yaml:2:"));  // where a key begins
    CHECK_THAT(message_of_parsing(repeated("- ", 70)), Contains("nested deeper than 60"));
    CHECK_THAT(message_of_parsing(repeated("? ", 70)), Contains("nested deeper than 60"));
    CHECK_THAT(message_of_parsing(repeated("{a: ", 70)), Contains("nested deeper than 60"));
    CHECK_THAT(message_of_parsing("a: " + repeated("[", 57) + repeated("]", 57)), Contains("nothing was thrown"));
    CHECK_THAT(message_of_parsing("? " + std::string(2000, 'k') + "\n: 1\n"),
               Contains("a key of 2000 bytes; allowed: at most 1024"));
    CHECK_THAT(message_of_parsing("a: 1\nb: '" + std::string(1 << 20, 'x') + "'\n"),
               Contains("m.yaml:2: a line of 1048581 bytes; allowed: at most 1048576"));
    CHECK_THAT(message_of_parsing("#" + repeated("\n#", 4 << 20)), Contains("bytes of YAML; allowed: at most 8388608"));
    CHECK_THAT(message_of_parsing("a: 1\n---\nb: 2\n"), Contains("several YAML documents; allowed: 1"));
    CHECK_THAT(confined(rlim_t{2} << 30, [] { (void)YamlNode::parse("a: [" + repeated(",\n", 4'000'000), "m.yaml"); }),
               Contains("m.yaml:"));
    CHECK_THAT(message_of_parsing("a:\n" + repeated("- 1\n", 1'100'000)), Contains("more than 1000000 nodes"));
}

TEST_CASE("yaml limits: aliases count as what they stand for, and none stands for itself", "[property]") {
    std::string laughs = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
    for (int i = 1; i <= 8; ++i)
        laughs += text("a", i, ": &a", i, " [", repeated(text("*a", i - 1, ", "), 9), "*a", i - 1, "]\n");
    CHECK_THAT(message_of_parsing(laughs), Contains("m.yaml:6:") && Contains("counting what aliases stand for"));
    CHECK_THAT(message_of_parsing("a: &a [1, *a]\n"), Contains("m.yaml:1:11: an alias of what it is itself a part of"));
    CHECK_THAT(message_of_parsing("a: &a\n  b: {c: *a}\n"),
               Contains("m.yaml:2:10: an alias of what it is itself a part of"));
    std::string deep = "a0: &a0 [1]\n";
    for (int i = 1; i <= 70; ++i) deep += text("a", i, ": &a", i, " [*a", i - 1, "]\n");
    CHECK_THAT(message_of_parsing(deep), Contains("nested deeper than 60"));
    CHECK_THAT(message_of_parsing("a: *b\n"), Contains("is not YAML"));
    const YamlNode good = YamlNode::parse("a: &x {b: [1, 2]}\nc: *x\n", "m.yaml");
    CHECK(good["c"]["b"].numbers() == std::vector<double>{1, 2});
    CHECK(good["c"]["b"].path() == "c.b");
}
