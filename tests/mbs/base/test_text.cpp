// Texts and numbers in them.
#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/host_locale.hpp"

#include <cstdio>
#include <cstring>
#include <iomanip>
#include <limits>
#include <random>

using namespace cardan;

namespace {

double any_double(std::mt19937_64& random) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return std::isfinite(value) ? value : 0.1;
}

std::string printed(const char* format, double value) {
    std::string out(400, '\0');
    out.resize(static_cast<std::size_t>(std::snprintf(out.data(), out.size(), format, value)));
    return out;
}

}  // namespace

// The C library is the second implementation.
TEST_CASE("text: shortest digits are read back as the same number, others are printf's", "[crosscheck]") {
    std::mt19937_64 random(5);
    for (int i = 0; i < 2000; ++i) {
        const double value = any_double(random);
        CHECK(read_number(digits(value)).value == value);
        CHECK(std::strtod(digits(value).c_str(), nullptr) == value);
        CHECK(digits(value, std::chars_format::scientific, 16) == printed("%.16e", value));
        CHECK(digits(value, std::chars_format::fixed, 4) == printed("%.4f", value));
    }
    constexpr double largest = std::numeric_limits<double>::max();
    CHECK(digits(-largest, std::chars_format::fixed, 30) == printed("%.30f", -largest));
    CHECK(digits(0.1) == "0.1");
    CHECK(digits(std::numeric_limits<double>::infinity()) == "inf");
}

TEST_CASE("text: a word is a number as a whole or says why it is none", "[property]") {
    for (const auto& [word, value] : {std::pair{"1.5", 1.5}, std::pair{"+2e3", 2000.0}, std::pair{"-.5", -0.5},
                                      std::pair{"7.", 7.0}, std::pair{"-0", 0.0}, std::pair{"1E-2", 0.01}}) {
        CAPTURE(word);
        CHECK(read_number(word).good());
        CHECK(read_number(word).value == value);
    }
    for (const char* word : {"", "+", "-", "+-1", "--1", "1,5", "1.5 ", " 1", "1.5m", "0x1p3", "1e", "one"}) {
        CAPTURE(word);
        CHECK(read_number(word).fault == ReadNumber::no_number);
    }
    CHECK(read_number("1e400").fault == ReadNumber::too_large);
    for (const char* word : {"inf", "-nan", "INFINITY"}) CHECK(read_number(word).fault == ReadNumber::infinite);
}

TEST_CASE("text: numbers, truth values and letters are those of the C locale in every host program", "[property]") {
    const auto all = [] {
        std::ostringstream out = text_stream();
        out << std::fixed << std::setprecision(2) << 1234567.5 << ' ' << 7654321 << ' ' << std::boolalpha << true;
        std::istringstream in = text_reader("1.5 2000.25");
        double a = 0, b = 0;
        in >> a >> b;
        std::string letters;
        for (int c = 0; c < 256; ++c) {
            const char byte = static_cast<char>(c);
            letters += text(is_digit(byte), is_letter(byte), is_control(byte), lower_case(byte), upper_case(byte));
        }
        return std::vector<std::string>{text(1234.5, " ", 1234567, " ", Complex(1000.5, 2)),
                                        digits(1234567.5),
                                        digits(1234567.5, std::chars_format::fixed, 3),
                                        out.str(),
                                        digits(a + b),
                                        letters,
                                        lower_case("\xC3\x84 AZ\xC4"),
                                        InputError("beam", "length [m]", 1234.5, "> 2000").what()};
    };
    const std::vector<std::string> in_c = all();
    CHECK(in_c[0] == "1234.5 1234567 (1000.5,2)");
    CHECK(in_c[3] == "1234567.50 7654321 true");
    CHECK(in_c[6] == "\xC3\x84 az\xC4");
    for (const char* name : {"de_DE.UTF-8", "de_DE.ISO-8859-1"}) {
        std::vector<std::string> hosted;
        std::string other;
        bool c_too = false;
        {
            const test::HostLocale host(name);
            hosted = all();
            std::ostringstream out;  // that the locale is a hostile one
            out << 1234.5;
            other = out.str() + printed(" %.1f", 0.5);
            c_too = host.in_c();
        }
        CAPTURE(name);
        CHECK(hosted == in_c);
        CHECK(other == (c_too ? "1.234,5 0,5" : "1.234,5 0.5"));
        if (!c_too) WARN("no locale " << name << " here (localedef): tested with std::locale alone");
    }
}
