// Which bytes are text, against the decoder of the C library; files that are not text.
#include "mbs/base/text_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <array>
#include <iconv.h>
#include <random>

using namespace cardan;
using Catch::Matchers::Contains;
using test::message_of;

namespace {

/// iconv from UTF-8 to UTF-32: how many bytes it takes before the first that it does not.
class Decoder {
public:
    Decoder() : to_utf32_(::iconv_open("UTF-32LE", "UTF-8")) {}
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { ::iconv_close(to_utf32_); }
    [[nodiscard]] bool works() const { return to_utf32_ != reinterpret_cast<iconv_t>(-1); }
    std::size_t length(std::string bytes) {
        ::iconv(to_utf32_, nullptr, nullptr, nullptr, nullptr);
        std::array<char, 64> out{};
        char *from = bytes.data(), *to = out.data();
        std::size_t left = bytes.size(), room = out.size();
        ::iconv(to_utf32_, &from, &left, &to, &room);
        return bytes.size() - left;
    }

private:
    iconv_t to_utf32_;
};

std::string of(std::initializer_list<int> bytes) {
    std::string all;
    for (int byte : bytes) all += static_cast<char>(byte);
    return all;
}

}  // namespace

TEST_CASE("text: UTF-8 ends where the C library's decoder says so", "[crosscheck]") {
    Decoder decoder;
    REQUIRE(decoder.works());
    std::size_t different = 0;
    const auto compare = [&](const std::string& bytes) {
        if (utf8_length(bytes) != decoder.length(bytes)) ++different;
    };
    for (int a = 0; a < 256; ++a)
        for (int b = 0; b < 256; ++b) compare(of({a, b}));
    // Beginnings of three and four bytes with second bytes at all limits, and what follows them.
    for (int a = 0xE0; a < 0x100; ++a)
        for (int b : {0x00, 0x7F, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC0, 0xFF})
            for (int c : {0x41, 0x7F, 0x80, 0xBF, 0xC0})
                for (int d : {0x41, 0x7F, 0x80, 0xBF, 0xC0}) compare(of({a, b, c, d}));
    std::mt19937 random(23);
    std::uniform_int_distribution<int> byte(0, 255), high(0x80, 0xF7);
    for (int i = 0; i < 100'000; ++i) compare(of({high(random), high(random), byte(random), high(random), 'x'}));
    CHECK(different == 0);
}

TEST_CASE("text: NUL and bytes that are not UTF-8 are refused with file, line and character column", "[property]") {
    CHECK_NOTHROW(require_text("a\n\tb\r\n\xC3\xA4\xE2\x82\xAC\xF0\x9F\x8C\x80", "a.csv"));
    CHECK_THROWS_WITH(require_text(std::string("ab\nc\xC3\xA4\0d", 8), "a.csv"),
                      Contains("a.csv:2:3: is no text: the character NUL"));
    CHECK_THROWS_WITH(require_text("ab\n\xC3\xA4 \xDA!", "a.csv"),
                      "a.csv:2:3: is not UTF-8: byte 0xDA; save it as UTF-8");
    CHECK_THROWS_WITH(require_text("\xED\xA0\x80", "a.csv"), Contains("a.csv:1:1: is not UTF-8: byte 0xED"));
    CHECK_NOTHROW(require_text("\xDA", "a.csv", TextRules::any_bytes));
    CHECK_THROWS_AS(require_text(std::string(1, '\0'), "a.csv", TextRules::any_bytes), ParseError);
    CHECK_THROWS_WITH(require_text(std::string(longest_text + 1, ' '), "a.csv"), Contains("allowed: 64 MiB"));
}

TEST_CASE("text: a file without an end is not read to the end", "[property]") {
    CHECK_THROWS_WITH(text_file("/dev/zero"), Contains("/dev/zero: is longer than 64 MiB"));
    CHECK_THROWS_WITH(text_file("/"), Contains("is a folder"));
    const test::Folder folder;
    const std::string content = std::string(200'000, 'x') + std::string(1, '\0') + "\n";
    std::ofstream(folder / "a", std::ios::binary) << content;
    CHECK(text_file(folder / "a") == content);
    CHECK_THROWS_WITH(text_file(folder / "b"), Contains("b: cannot be read: No such file"));
}
