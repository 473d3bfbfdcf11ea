/// @file
/// The model files of tests/data: in a folder of their own, to be changed and read again.
#pragma once

#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "turbines/readers/openfast.hpp"
#include "turbines/yaml/description.hpp"

#include <algorithm>
#include <initializer_list>
#include <sstream>
#include <vector>

namespace cardan::test {

inline std::string data_file(const std::string& name) {
    return std::string(CARDAN_SOURCE_DIR) + "/tests/data/" + name;
}

/// A copy of a folder of models.
struct ModelFolder {
    Folder folder;
    explicit ModelFolder(const std::string& kind) {
        for (const auto& entry : std::filesystem::directory_iterator(data_file(kind)))
            std::filesystem::copy_file(entry.path(), folder / entry.path().filename().string());
    }
    [[nodiscard]] std::string operator/(const std::string& name) const { return folder / name; }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    void replace(const std::string& name, const std::string& old_text, const std::string& new_text) const {
        std::string all = bytes_of(folder / name);
        const std::size_t at = all.find(old_text);
        if (at == std::string::npos) throw InputError("test", "text to replace", old_text, "one of the file");
        write(name, all.replace(at, old_text.size(), new_text));
    }
};

/// Checks that the message of the error that `call` throws contains all `parts`.
template <class Call>
void check_error(Call&& call, std::initializer_list<std::string> parts) {
    const std::string message = message_of(call);
    for (const std::string& part : parts) {
        CAPTURE(message, part);
        CHECK(message.find(part) != std::string::npos);
    }
}

/// Everything that counts of a machine that was read, as a text; not its name and the text of the files.
inline std::string state(turbines::TurbineFile file) {
    file.description.name = file.description.source = "";
    return text(turbines::to_yaml(file.description), file.rotor_speed, " ", file.pitch);
}

/// Is there a note on the keyword whose reason contains `why`?
inline bool has_note(const std::vector<turbines::FileNote>& notes, const std::string& keyword, const std::string& why) {
    return std::any_of(notes.begin(), notes.end(), [&](const turbines::FileNote& n) {
        return n.keyword.find(keyword) != std::string::npos && n.why.find(why) != std::string::npos;
    });
}

inline std::vector<std::string> lines_of(const std::string& all) {
    std::vector<std::string> lines;
    std::istringstream in(all);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

inline std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    return all;
}

/// Sections of two lines agree to the tolerance, measured by the largest entries, at places that are no stations.
inline double difference(const BeamLine& a, const BeamLine& b) {
    double largest = std::abs(a.length - b.length) / a.length;
    for (int i = 0; i <= 97; ++i) {
        const double x = std::min(a.length, b.length) * i / 97.0;
        const BeamSection s = a.section(x), t = b.section(x);
        const Vec6 d = s.compliance.diagonal().cwiseSqrt();
        for (Eigen::Index j = 0; j < 6; ++j)
            for (Eigen::Index k = 0; k < 6; ++k)
                if (d(j) > 0 && d(k) > 0)
                    largest = std::max(largest, std::abs(s.compliance(j, k) - t.compliance(j, k)) / (d(j) * d(k)));
                else
                    largest = std::max(largest, std::abs(t.compliance(j, k)));
        largest = std::max(largest, std::abs(s.mass - t.mass) / s.mass);
        largest = std::max(largest, (s.centre - t.centre).norm());
        largest = std::max(largest, (s.J - t.J).norm() / std::max(1e-3 * s.mass, s.J.norm()));
        largest = std::max(largest, std::abs(s.beta - t.beta));
        largest = std::max(largest, (a.pose(x).p - b.pose(x).p).norm() + (a.pose(x).R - b.pose(x).R).norm());
    }
    return largest;
}

}  // namespace cardan::test
