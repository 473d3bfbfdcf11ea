/// @file
/// A host program's locale with decimal commas, grouped digits and other letters.
#pragma once

#include <clocale>
#include <cstdlib>
#include <locale>
#include <string>

namespace cardan::test {

/// While it lives, 1234.5 is "1.234,5" for C++ (by facets of its own, which nobody needs to have installed) and, where
/// the locale is there, for C. Those that CMake makes (tests/CMakeLists.txt): de_DE.UTF-8, and de_DE.ISO-8859-1, in
/// which bytes above 127 are letters and control characters.
class HostLocale {
public:
    explicit HostLocale(const char* name)
        : cpp_(std::locale::global(std::locale(std::locale::classic(), new Numbers))),
          c_(std::setlocale(LC_ALL, nullptr)) {
        ::setenv("LOCPATH", CARDAN_TEST_LOCALES, 1);
        in_c_ = std::setlocale(LC_ALL, name) != nullptr;
        ::unsetenv("LOCPATH");
    }
    HostLocale(const HostLocale&) = delete;
    HostLocale& operator=(const HostLocale&) = delete;
    ~HostLocale() {
        std::locale::global(cpp_);
        std::setlocale(LC_ALL, c_.c_str());
    }
    /// Has C the locale, too?
    [[nodiscard]] bool in_c() const { return in_c_; }

private:
    struct Numbers : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
        std::string do_truename() const override { return "wahr"; }
        std::string do_falsename() const override { return "falsch"; }
    };
    std::locale cpp_;
    std::string c_;
    bool in_c_ = false;
};

}  // namespace cardan::test
