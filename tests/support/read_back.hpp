/// @file
/// Files of ours in the hands of other programs: Debian's python3-xarray, python3-netcdf4, python3-h5netcdf,
/// netcdf-bin.
#pragma once

#include "mbs/base/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace cardan::test {

/// What is expected of a file, written as tests/peers/read_back.py takes it.
class ReadBack {
public:
    /// @param options  further ones of read_back.py
    explicit ReadBack(std::string options = {}) : options_(std::move(options)) {}
    /// @param path  "/group/variable", "/group/variable@attribute" or "/@attribute"
    void texts(const std::string& path, const std::vector<std::string>& values) {
        lines_ += path;
        for (std::string value : values) {
            for (std::size_t at = 0; (at = value.find('\n', at)) != std::string::npos; at += 2)
                value.replace(at, 1, "\\n");
            lines_ += "\t" + value;
        }
        lines_ += "\n";
    }
    void numbers(const std::string& path, const std::vector<double>& values) {
        std::vector<std::string> words;
        for (const double value : values) {
            char digits[40];
            std::snprintf(digits, sizeof digits, "%.17g", value);
            words.emplace_back(std::isnan(value) ? "nan" : digits);
        }
        texts(path, words);
    }
    /// Are these programs there? If not, the test has nothing to say but that.
    [[nodiscard]] static bool possible() {
        static const bool there =
            std::system("/usr/bin/python3 -c 'import xarray, netCDF4, h5netcdf' >/dev/null 2>&1") == 0;
        if (!there) WARN("left out: needs Debian's python3-xarray, python3-netcdf4 and python3-h5netcdf");
        return there;
    }
    /// What they say of the file, after "ok: " or "wrong: ".
    [[nodiscard]] std::string of(const Folder& folder, const std::string& file) const {
        const std::string expected = folder / "expected.txt", said = folder / "said.txt";
        std::ofstream(expected, std::ios::binary) << lines_;
        const int code = std::system(("/usr/bin/python3 " CARDAN_SOURCE_DIR "/tests/peers/read_back.py " + file +
                                      " --expected " + expected + " " + options_ + " >" + said + " 2>&1")
                                         .c_str());
        return (code == 0 ? "ok: " : "wrong: ") + bytes_of(said);
    }

private:
    std::string options_;
    std::string lines_;
};

}  // namespace cardan::test
